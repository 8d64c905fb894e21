#include "core/camera_motion.hpp"

namespace stdc {

Eigen::Vector2d CameraMotion::project(const Camera& camera, const Eigen::Vector3d& point_at_middle) const {
  Eigen::Vector2d pixel = camera.project(point_at_middle);
  if (readout_time == 0) return pixel;
  // The row decides the time and the time the row: the row moves by little, so two rounds are exact to 0.1
  // px.
  for (int round = 0; round < 2; ++round) {
    const Eigen::Vector3d point = later(point_at_middle, row_time(camera.row_of(pixel)));
    if (!(point.z() > 1e-3)) break;
    pixel = camera.project(point);
  }
  return pixel;
}

}  // namespace stdc
