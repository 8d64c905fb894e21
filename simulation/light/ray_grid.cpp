#include "simulation/light/ray_grid.hpp"

namespace stdc::simulation {

RayGrid::RayGrid(const Camera& camera)
    : width_(camera.width),
      height_(camera.height),
      pixel_angle_(static_cast<float>(2 / (camera.fx + camera.fy))) {
  rays_.reserve(static_cast<std::size_t>(width_) * height_);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Eigen::Vector2d ideal = camera.undistort({x, y});
      rays_.push_back(camera.unproject(ideal, 1).head<2>().cast<float>());
    }
  }
}

Eigen::Vector2f RayGrid::at(int x, int y, float dx, float dy) const {
  const int x0 = x + 1 < width_ ? x : x - 1, y0 = y + 1 < height_ ? y : y - 1;
  return at(x, y) + dx * (at(x0 + 1, y) - at(x0, y)) + dy * (at(x, y0 + 1) - at(x, y0));
}

}  // namespace stdc::simulation
