#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace stdc {

/// Depth [m] of the surface at a place of a depth image: of the plane through the pixels around it, for which
/// the inverse depth is an affine function of the pixel. Varies smoothly with the place, and has less noise
/// than a pixel. 0 where there is no one surface: too many pixels are missing, or they do not lie on a plane.
double plane_depth_at(const cv::Mat& depth, double units_per_metre, const Eigen::Vector2d& pixel);

}  // namespace stdc
