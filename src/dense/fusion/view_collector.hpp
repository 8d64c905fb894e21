#pragma once

#include <optional>

#include "atlas/atlas_snapshot.hpp"
#include "atlas/dense_view.hpp"
#include "dense/dense_settings.hpp"
#include "dense/fusion/depth_window.hpp"
#include "dense/fusion/placed_view.hpp"
#include "dense/fusion/rectifier.hpp"
#include "dense/fusion/view_coverage.hpp"

namespace stdc {

/// A frame on its way into the dense map.
struct DenseFrame {
  int frame = 0;
  double timestamp = 0;  ///< [s]
  KeyframeId reference;  ///< the keyframe it was tracked from...
  Pose cam_from_reference;
  cv::Mat depth;  ///< as in RgbdImage
  // What is not used of it; CV_8UC1, not 0 = dynamic, or empty: nothing is.
  cv::Mat dynamic;   ///< by what it is
  cv::Mat moving;    ///< by geometry
  cv::Mat doubtful;  ///< what may be
  bool starts_view = true;
  // Of a frame that starts a view:
  cv::Mat colour;       ///< as in RgbdImage
  Pose world_from_cam;  ///< as now known
  MapId map;
  // Of one that does not:
  Pose frame_from_window;  ///< from the first frame of its view
};

/// Says which frames start a view: cheap, so that the tracker can ask at once and hand over colour only with
/// those.
class ViewPlanner {
 public:
  explicit ViewPlanner(const DenseSettings& settings) : settings_(settings) {}

  /// Sets `starts_view` and what is below it, but for the colour, of a frame that has its reference and pose,
  /// by the keyframes' present poses.
  void plan(const AtlasSnapshot& snapshot, DenseFrame& frame);

 private:
  struct Window {
    KeyframeId reference;
    Pose cam_from_reference;
    int frames = 1;
  };
  DenseSettings settings_;
  std::optional<Window> window_;
};

/// Makes views of frames.
class ViewCollector {
 public:
  ViewCollector(const Camera& camera, const DenseSettings& settings);

  const Pinhole& pinhole() const { return rectifier_.pinhole(); }
  /// The next frame, in order of time.
  void add(const DenseFrame& frame);
  /// Views of a loaded map, all placed in it; before the first frame.
  void set_views(const std::vector<PlacedView>& views, MapId map);
  /// All views, that under way included.
  DenseViews views() const;
  /// Those that are done: cheap.
  DenseViews closed_views() const;
  /// How many have been closed so far, dropped ones included.
  int closed() const { return closed_; }

 private:
  struct OpenView {
    DenseView view;  ///< without its images
    cv::Mat colour;
    Pose world_from_cam;  ///< as known when it was begun
    MapId map;
    DepthWindow window;
  };
  struct Kept {
    std::shared_ptr<const DenseView> view;
    ViewCoverage::Cells cells;
  };
  cv::Mat rectified(const cv::Mat& mask) const;
  std::shared_ptr<const DenseView> encoded(const OpenView& open) const;
  void close();
  void drop_redundant();

  DenseSettings settings_;
  Rectifier rectifier_;
  std::vector<Kept> kept_;
  ViewCoverage coverage_;
  std::optional<OpenView> open_;
  int closed_ = 0;
};

}  // namespace stdc
