#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "dense/inpainting/background_view.hpp"
#include "dense/inpainting/inpainting_settings.hpp"

namespace stdc {

/// Views of the static scene, a bounded number. One is kept every `view_interval` frames, and whenever a
/// frame shows enough that no kept view has seen, such as what a mover has just uncovered; when there are too
/// many, the one goes whose surfaces the others have seen most often.
///
/// Poses are those of the finished trajectory, which follow the map; the space is counted in cells of it.
class BackgroundStore {
 public:
  using Views = std::vector<std::shared_ptr<const BackgroundView>>;

  explicit BackgroundStore(const InpaintingSettings& settings) : settings_(settings) {}

  /// Keeps the view if it is worth it. Views come in order of time.
  void add(std::shared_ptr<const BackgroundView> view);
  /// The views, at most `InpaintingSettings.views`, that together see most of what `region` of a frame hides,
  /// preferring those that are near in time and place.
  /// @param region  CV_8UC1, 255 = to be filled
  Views choose(const ViewPose& at, const cv::Mat& region, const RayTable& rays) const;

  std::size_t size() const { return kept_.size(); }

 private:
  /// A cell of space in a map, at a scale of distances: near views of it show more than far ones.
  using Cell = std::array<std::int32_t, 5>;
  struct Kept {
    std::shared_ptr<const BackgroundView> view;
    std::vector<Cell> cells;  ///< that it shows, sorted, each once
  };
  static std::vector<Cell> cells_of(const BackgroundView& view);
  void drop_one();

  InpaintingSettings settings_;
  std::vector<Kept> kept_;      ///< by time
  std::map<Cell, int> counts_;  ///< kept views that show a cell
};

}  // namespace stdc
