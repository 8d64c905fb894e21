#include "dense/ray_table.hpp"

#include <limits>

namespace stdc {

RayTable::RayTable(const Camera& camera)
    : camera_(camera),
      distorted_(camera.has_distortion()),
      fx_(static_cast<float>(camera.fx)),
      fy_(static_cast<float>(camera.fy)),
      cx_(static_cast<float>(camera.cx)),
      cy_(static_cast<float>(camera.cy)),
      rays_(camera.height, camera.width) {
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector2d raw(x, y);
      if (!camera.has_ideal(raw)) {
        rays_(y, x) = cv::Vec2f::all(std::numeric_limits<float>::quiet_NaN());
        continue;
      }
      const Eigen::Vector2d ideal = distorted_ ? camera.undistort(raw) : raw;
      rays_(y, x) = {static_cast<float>((ideal.x() - camera.cx) / camera.fx),
                     static_cast<float>((ideal.y() - camera.cy) / camera.fy)};
    }
  }
}

Eigen::Vector2f RayTable::project_distorted(const Eigen::Vector3f& point) const {
  const Eigen::Vector2d ideal = camera_.project(point.cast<double>());
  // Far outside a lens model may fold back into the image.
  if (!camera_.shows(ideal)) return {-1e6F, -1e6F};
  return camera_.distort(ideal).cast<float>();
}

}  // namespace stdc
