#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "features/feature_settings.hpp"
#include "features/image.hpp"

namespace stdc {

/// Level pixels between a keypoint and the edge of its level: the orientation and descriptor patches fit.
inline constexpr int kBorder = 19;

/// Number of levels for an image [px]: the setting if it is not 0; else Eq. 2, Round(max(W, H) / 100), at
/// least 1, for the improved selection, and 8 for the classic one.
int level_count(const FeatureSettings& settings, cv::Size image_size);

/// Size [px] of each level: as many pixels as have their centre, mapped by level_to_image, on the level
/// below.
std::vector<cv::Size> level_sizes(const FeatureSettings& settings, cv::Size image_size);

/// Keypoints wanted per level; the sum is settings.keypoints. Improved: proportional to the area of the
/// level: total area S of Eq. 3, density X of Eq. 4, budget N_i of Eq. 5, with s = 1 / scale_factor. Classic:
/// proportional to the scale (Mur-Artal and Tardos, ORB-SLAM, 2015). A level without room for a patch gets
/// none; its share goes to the others in proportion.
std::vector<int> level_budgets(const FeatureSettings& settings, const std::vector<cv::Size>& sizes);

/// Level-0 coordinate of a coordinate of a level with that scale; (0, 0) is the centre of the first pixel.
inline float level_to_image(float coordinate, float scale) { return (coordinate + 0.5F) * scale - 0.5F; }
/// The inverse of level_to_image.
inline float image_to_level(float coordinate, float scale) { return (coordinate + 0.5F) / scale - 0.5F; }

/// The image at falling scales, each level bilinearly sampled from the one below; all of one stride.
class Pyramid {
 public:
  /// Copies `grey` (CV_8UC1) into level 0 and makes the others.
  void build(const cv::Mat& grey, const FeatureSettings& settings);
  int levels() const { return static_cast<int>(sizes_.size()); }
  const PaddedImage& level(int i) const { return images_[static_cast<std::size_t>(i)]; }
  const std::vector<cv::Size>& sizes() const { return sizes_; }

 private:
  std::vector<cv::Size> sizes_;
  std::vector<PaddedImage> images_;
};

}  // namespace stdc
