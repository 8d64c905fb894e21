#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "commands/segment/segment_images.hpp"
#include "segmentation/mask_list.hpp"

namespace stdc::app {

/// What a mask is compared with.
struct TruthMask {
  cv::Mat mask;    ///< CV_8UC1, not 0 = dynamic
  cv::Mat ignore;  ///< CV_8UC1, not 0 = in doubt; may be empty
};

/// How true masks are stored.
enum class TruthKind {
  masks,   ///< 128 and above = dynamic
  labels,  ///< 0 = background, 255 = in doubt, others = dynamic
};

/// A folder of true masks.
class TruthMasks {
 public:
  TruthMasks(std::filesystem::path folder, TruthKind kind);

  /// The true mask of an image: the PNG of the same name or, for masks of sequences, of the same time (as
  /// `run --masks` finds it); nothing if there is none. It may lie on the stored image or on the upright one,
  /// where their sizes differ. Throws Error for a damaged one or one of another shape.
  /// @param size  of the stored image
  std::optional<TruthMask> load(const SegmentImage& image, cv::Size size, Orientation orientation);

 private:
  std::filesystem::path folder_;
  TruthKind kind_;
  std::optional<std::vector<MaskFile>> by_time_;  ///< listed when first needed
};

}  // namespace stdc::app
