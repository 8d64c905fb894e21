#pragma once

#include <vector>

#include "simulation/light/baked_light.hpp"
#include "simulation/light/ray_scene.hpp"
#include "simulation/scene/world.hpp"

namespace stdc {

/// What a ray brings back from the surface it meets.
struct Shade {
  Rgb colour = Rgb::Zero();
  float infrared = 0;  ///< how well the depth sensor's pattern returns, 0..1
};

/// Highlights of the lights on a glossy surface (Blinn 1977). `way` points from the eye, both unit vectors.
Rgb highlights(const std::vector<AreaLight>& lights, const Material& material,
               const Eigen::Vector3f& position, const Eigen::Vector3f& normal, const Eigen::Vector3f& way);

/// Infrared that comes back from a surface seen under an angle with this cosine.
float infrared_return(const Material& material, float cosine);

/// Colours what stands still: texture times baked light, plus highlights.
class SurfaceShader {
 public:
  /// Both must outlive this.
  SurfaceShader(const World& world, const BakedLight& light);

  /// @param direction    of the ray, any length
  /// @param pixel_angle  angle between the rays of neighbouring pixels [rad]
  /// @param shadow       what moving things leave of the light, 0..1
  Shade shade(const Hit& hit, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
              float pixel_angle, float shadow) const;
  /// Whether the colours of two neighbouring hits may differ by more than their textures do.
  bool surfaces_differ(const Hit& a, const Hit& b) const;
  /// Normal where the ray hit, turned to the eye.
  Eigen::Vector3f normal(const Hit& hit, const Eigen::Vector3f& direction) const;

 private:
  const World& world_;
  const BakedLight& light_;
  std::vector<float> texels_per_metre_;  ///< of each patch
};

}  // namespace stdc
