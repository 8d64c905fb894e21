#include "calibration/surface_depth.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "features/frame_features.hpp"

namespace stdc {

double plane_depth_at(const cv::Mat& depth, double units_per_metre, const Eigen::Vector2d& pixel) {
  constexpr int kReach = 3;
  constexpr double kMinShare = 0.7, kMaxResidual = 0.006;  // [1/m]
  const int x0 = static_cast<int>(std::lround(pixel.x())), y0 = static_cast<int>(std::lround(pixel.y()));
  if (x0 < kReach || y0 < kReach || x0 + kReach >= depth.cols || y0 + kReach >= depth.rows) return 0;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0;
  for (int y = y0 - kReach; y <= y0 + kReach; ++y) {
    for (int x = x0 - kReach; x <= x0 + kReach; ++x) {
      const float z = depth_at(depth, units_per_metre, x, y);
      if (z <= 0) continue;
      const Eigen::Vector3d row(1, x - pixel.x(), y - pixel.y());
      normal += row * row.transpose();
      right += row / z;
      squares += 1.0 / z / z;
    }
  }
  constexpr double kPixels = (2 * kReach + 1) * (2 * kReach + 1);
  if (normal(0, 0) < kMinShare * kPixels) return 0;
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  const double residual = std::sqrt(std::max(0.0, squares - plane.dot(right)) / normal(0, 0));
  if (!(residual <= kMaxResidual) || !(plane[0] > 0)) return 0;
  return 1 / plane[0];
}

}  // namespace stdc
