#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dense/inpainting/background_view.hpp"

namespace stdc {

/// A view as it fits a frame.
struct AlignedView {
  const BackgroundView* view = nullptr;
  Pose view_from_frame;
  cv::Vec3f gain{1, 1, 1};  ///< frame = gain * view, by channel
  double residual = 0;      ///< mean robust difference of brightness where both see the same [grey levels]
};

/// Static pixels of a frame by which other views are aligned to it: of strong gradient, spread over the
/// image.
class AlignmentTarget {
 public:
  AlignmentTarget(const BackgroundView& frame, const RayTable& rays);

  /// Corrects the pose of a view, known to a few pixels, such that its brightness fits: Gauss-Newton on the
  /// photometric error with a gain (direct image alignment, as in DVO: Kerl et al., ICRA 2013, III; the
  /// gradients are those of the frame: inverse compositional, Baker and Matthews, IJCV 2004, 3.2). First at
  /// half the size. Where the corrected pose does not fit better, or is far from the known one, that stays.
  /// The gain by channel is the ratio of the mean colours of the pixels that both see.
  /// @param align  false: only the gain
  AlignedView align(const BackgroundView& view, bool align) const;

 private:
  struct Pixel {
    Eigen::Vector3f point;  ///< [m, frame]
    int x, y;
    float value[2];                          ///< brightness at full and at half size
    Eigen::Matrix<float, 6, 1> jacobian[2];  ///< of it by a motion of the frame, twist as in Pose::exp
  };
  struct Fit {
    double cost = 0;  ///< mean robust difference
    int count = 0;
    float gain = 1;
  };
  void add(cv::Point at);
  Fit evaluate(const BackgroundView& view, const Pose& view_from_frame, int level, float gain,
               Eigen::Matrix<double, 6, 6>* hessian, Eigen::Matrix<double, 6, 1>* gradient) const;
  /// Where a view shows a point [m, view]; nothing if it does not, or shows another surface there.
  std::optional<Eigen::Vector2f> find(const Eigen::Vector3f& point, const BackgroundView& view) const;
  /// How well a pose fits at full size, with the best gain.
  Fit judge(const BackgroundView& view, const Pose& view_from_frame, float gain) const;
  Pose refine(const BackgroundView& view, Pose view_from_frame, float& gain) const;
  void find_gain(AlignedView& aligned) const;

  const BackgroundView& frame_;
  const RayTable& rays_;
  std::vector<Pixel> pixels_;
};

}  // namespace stdc
