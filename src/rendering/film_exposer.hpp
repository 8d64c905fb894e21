#pragma once

#include "core/pose.hpp"
#include "rendering/film.hpp"
#include "rendering/moving_things.hpp"
#include "rendering/ray_grid.hpp"
#include "rendering/surface_shader.hpp"

namespace stdc {

/// Exposes film by casting rays: one through every pixel's centre, four more where surfaces meet (textures
/// are filtered by their mip-maps and need no more).
class FilmExposer {
 public:
  /// All must outlive this.
  FilmExposer(const RayGrid& rays, const RayScene& scene, const SurfaceShader& shader)
      : rays_(rays), scene_(scene), shader_(shader) {}

  /// @param moving  people and things that move, as they stand in this moment; may be null
  Film expose(const Pose& world_from_cam, const MovingThings* moving) const;

 private:
  const RayGrid& rays_;
  const RayScene& scene_;
  const SurfaceShader& shader_;
};

}  // namespace stdc
