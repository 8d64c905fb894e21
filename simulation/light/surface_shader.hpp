#pragma once

#include <vector>

#include "simulation/light/baked_light.hpp"
#include "simulation/light/ray_scene.hpp"
#include "simulation/scene/world.hpp"

namespace stdc::simulation {

/// What a ray sees on the surface it hits.
struct Shade {
  Rgb colour = Rgb::Zero();
  float infrared = 0;  ///< share of the depth sensor's pattern that comes back, 0..1
};

/// Highlights of the lights on a glossy surface (Blinn 1977). `normal` and `view`,
/// which points away from the camera, are unit vectors.
Rgb highlights(const std::vector<AreaLight>& lights, const Material& material,
               const Eigen::Vector3f& position, const Eigen::Vector3f& normal, const Eigen::Vector3f& view);

/// Share of the infrared pattern that a surface sends back at an angle of incidence with this cosine.
float infrared_return(const Material& material, float cosine);

/// Shades the static scene: texture times baked light, plus highlights.
class SurfaceShader {
 public:
  /// Keeps references to both.
  SurfaceShader(const World& world, const BakedLight& light);

  /// @param direction    of the ray, any length
  /// @param pixel_angle  angle between the rays of neighbouring pixels [rad]
  /// @param shadow       share of the light that moving objects let through, 0..1
  Shade shade(const Hit& hit, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
              float pixel_angle, float shadow) const;
  /// Whether the colours of two neighbouring hits may differ by more than their textures do.
  bool surfaces_differ(const Hit& a, const Hit& b) const;
  /// Normal at the hit, facing the camera.
  Eigen::Vector3f normal(const Hit& hit, const Eigen::Vector3f& direction) const;

 private:
  const World& world_;
  const BakedLight& light_;
  std::vector<float> texels_per_metre_;  ///< of each patch
};

}  // namespace stdc::simulation
