#include "input/registration/lens_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stdc {
namespace {

/// The largest squared distance from the axis, in normalised coordinates, that the border of an image shows.
double max_squared_distance(const Camera& camera) {
  double largest = 0;
  const auto take = [&](double x, double y) {
    const Eigen::Vector2d ideal = camera.undistort({x, y});
    const Eigen::Vector2d n((ideal.x() - camera.cx) / camera.fx, (ideal.y() - camera.cy) / camera.fy);
    largest = std::max(largest, n.squaredNorm());
  };
  constexpr int kNodes = 64;  // along each side
  const double right = camera.width - 1, bottom = camera.height - 1;
  for (int i = 0; i <= kNodes; ++i) {
    const double x = right * i / kNodes, y = bottom * i / kNodes;
    take(x, 0), take(x, bottom), take(0, y), take(right, y);
  }
  return largest;
}

}  // namespace

LensRows::LensRows(const Camera& camera) {
  if (!camera.has_distortion()) return;
  if (camera.lens == LensModel::equidistant) {
    table_ = LensTable(camera);
    return;
  }
  const auto single = [](double x) { return static_cast<float>(x); };
  constexpr double kBeside = 1.02;  // a depth pixel reaches into the image from beside it
  brown_ = true;
  lens_ = {single(camera.fx),
           single(camera.fy),
           single(camera.cx),
           single(camera.cy),
           single(camera.k1),
           single(camera.k2),
           single(camera.p1),
           single(camera.p2),
           single(camera.k3),
           single(camera.k4),
           single(camera.k5),
           single(camera.k6),
           single(kBeside * max_squared_distance(camera))};
}

void LensRows::distort(float* u, float* v, std::size_t count) const {
  if (brown_) return distort_row(lens_, u, v, count);
  if (table_.empty()) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (!table_.distort(u[i], v[i])) u[i] = std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace stdc
