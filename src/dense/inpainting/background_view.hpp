#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/ids.hpp"
#include "core/pose.hpp"
#include "core/rgbd_image.hpp"
#include "dense/ray_table.hpp"

namespace stdc {

/// What a pixel of a view is good for.
enum class Seen : std::uint8_t {
  nothing,  ///< it is dynamic, near to that, or without a ray
  colour,   ///< static, without a depth of its own: that in `BackgroundView::depth` is a guess
  surface,  ///< static, with a measured depth
};

/// Where and when a frame was taken.
struct ViewPose {
  int frame = 0;
  double timestamp = 0;  ///< [s]
  MapId map;             ///< poses of different maps have nothing to do with each other
  Pose world_from_cam;
};

/// A frame with its static part made ready to be carried to other frames. Raw pixels throughout.
struct BackgroundView {
  ViewPose at;
  cv::Mat colour;     ///< CV_8UC1 or CV_8UC3, as given
  cv::Mat grey;       ///< CV_8UC1
  cv::Mat half_grey;  ///< CV_8UC1, half the size
  cv::Mat depth;      ///< CV_32FC1 [m], guessed where it was not measured; 0 only if nothing was measured
  cv::Mat seen;       ///< CV_8UC1 of Seen
  /// Static points, some with a guessed depth, on a grid of kGrid pixels [m, camera frame].
  std::vector<Eigen::Vector3f> points;

  static constexpr int kGrid = 8;  ///< [px]
  Seen seen_at(int x, int y) const { return static_cast<Seen>(seen.at<std::uint8_t>(y, x)); }
};

/// @param dynamic  CV_8UC1, 255 = dynamic, or empty: nothing is
/// @param margin   [px] around it that is not used either
/// The colour image is shared, not copied.
BackgroundView make_view(const RgbdImage& image, const cv::Mat& dynamic, int margin, const ViewPose& at,
                         const RayTable& rays);

/// The depth of an image as CV_32FC1 [m], 0 where there is none.
cv::Mat depth_in_metres(const RgbdImage& image, const RayTable& rays);

/// A mask grown by a disc of that radius [px]; CV_8UC1.
cv::Mat grown(const cv::Mat& mask, int radius);

}  // namespace stdc
