#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "features/detection/pyramid.hpp"

namespace stdc {

/// What direct alignment needs of a frame.
struct DirectView {
  std::shared_ptr<const Pyramid> pyramid;
  std::vector<float> depths;  ///< z [m] at DirectAligner's grid of pixels, row by row; 0: missing or moving
};

struct DirectAlignment {
  Pose frame_from_last;
  /// Inverse covariance of a left perturbation exp(twist) * frame_from_last, twist = (translation [m],
  /// rotation [rad]). Neighbouring pixels err together, and so much the more where blur smears them: it is
  /// taken for that of one pixel in a hundred.
  Matrix6d information = Matrix6d::Zero();
  double depth_agreement = 0;  ///< share of the points seen in both frames whose depths agree
};

/// Aligns the brightness of two images of an RGB-D camera as a whole: the pose that makes what the last frame
/// saw look in this one as it did there. Where a fast turn smears both images alike, corners and descriptors
/// cannot be matched, and this still can.
///
/// Coarse to fine, inverse compositional (Baker and Matthews, 'Lucas-Kanade 20 Years On', IJCV 2004), weights
/// of Student's t-distribution (Kerl, Sturm and Cremers, 'Robust Odometry Estimation for RGB-D Cameras', ICRA
/// 2013), gain and offset of the brightness found along with the pose. The depth of this frame has no part in
/// it and is asked afterwards whether it agrees. A rolling shutter shears both images alike as long as the
/// camera keeps its velocity; what is left of it is for those who refine the pose.
class DirectAligner {
 public:
  explicit DirectAligner(const Camera& camera);

  /// Depths of an image (CV_16UC1 or CV_32FC1, registered) on the grid; empty where there is none.
  std::vector<float> sample(const cv::Mat& depth) const;
  /// Takes away the depths where a mask (CV_8UC1 of the image's size, or empty) is not 0.
  void forget(const cv::Mat& mask, std::vector<float>& depths) const;

  /// @param initial  frame_from_last to begin with; up to about 25 pixels off
  /// @return nothing if too little is seen, or what was found does not look right or contradicts the depths
  std::optional<DirectAlignment> align(const DirectView& last, const DirectView& frame,
                                       const Pose& initial) const;

 private:
  double agreement(const DirectView& last, const DirectView& frame, const Pose& frame_from_last) const;

  Camera camera_;
  int columns_ = 0, rows_ = 0;
  std::vector<Eigen::Vector3d> rays_;  ///< of the grid's pixels, z = 1
};

}  // namespace stdc
