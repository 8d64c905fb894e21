#pragma once

#include "simulation/people/body_shape.hpp"
#include "simulation/scene/texture.hpp"

namespace stdc::simulation {

/// The colours of a person.
class PersonTextures {
 public:
  explicit PersonTextures(const PersonAppearance& appearance);

  /// Linear colour of a point of the body at rest.
  /// @param seen  footprint of a pixel there [m]
  Rgb colour(BodyRegion region, const Eigen::Vector3f& at_rest, const Eigen::Vector3f& normal_at_rest,
             float seen) const;

 private:
  Rgb round(const Texture& texture, const Eigen::Vector3f& at_rest, float seen) const;

  float height_;
  std::vector<Texture> textures_;  ///< by BodyRegion
  std::vector<Texture> print_;     ///< on the chest; one or none
};

}  // namespace stdc::simulation
