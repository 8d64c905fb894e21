#pragma once

#include <functional>

#include "core/pose.hpp"
#include "simulation/light/ideal_image.hpp"
#include "simulation/light/moving_objects.hpp"
#include "simulation/light/ray_grid.hpp"
#include "simulation/light/surface_shader.hpp"

namespace stdc::simulation {

/// Renders a frame by casting rays: one through each pixel's centre, four more where surfaces meet (inside a
/// surface, mip-maps filter the texture).
class RayRenderer {
 public:
  /// Keeps references to all.
  RayRenderer(const RayGrid& rays, const RayScene& scene, const SurfaceShader& shader)
      : rays_(rays), scene_(scene), shader_(shader) {}

  /// @param moving  people and moving objects at this moment; may be null
  IdealImage render(const Pose& world_from_cam, const MovingObjects* moving) const;
  /// The same through a rolling shutter.
  /// @param world_from_cam  when a row is read
  IdealImage render_rows(const std::function<Pose(double row)>& world_from_cam,
                         const MovingObjects* moving) const;

 private:
  const RayGrid& rays_;
  const RayScene& scene_;
  const SurfaceShader& shader_;
};

}  // namespace stdc::simulation
