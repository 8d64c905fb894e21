#pragma once

#include "core/pose.hpp"
#include "simulation/light/ideal_image.hpp"
#include "simulation/light/ray_grid.hpp"
#include "simulation/light/surface_shader.hpp"
#include "simulation/scene/moving_things.hpp"

namespace stdc {

/// Exposes film by casting rays: one through every pixel's centre, four more where surfaces meet (textures
/// are filtered by their mip-maps and need no more).
class RayRenderer {
 public:
  /// All must outlive this.
  RayRenderer(const RayGrid& rays, const RayScene& scene, const SurfaceShader& shader)
      : rays_(rays), scene_(scene), shader_(shader) {}

  /// @param moving  people and things that move, as they stand in this moment; may be null
  IdealImage expose(const Pose& world_from_cam, const MovingThings* moving) const;

 private:
  const RayGrid& rays_;
  const RayScene& scene_;
  const SurfaceShader& shader_;
};

}  // namespace stdc
