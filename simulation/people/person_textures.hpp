#pragma once

#include "simulation/people/body_shape.hpp"
#include "simulation/scene/texture.hpp"

namespace stdc {

/// How a person's covers are coloured.
class PersonTextures {
 public:
  explicit PersonTextures(const PersonLook& look);

  /// Linear colour of a point of the body at rest.
  /// @param seen  size of what a pixel sees there [m]
  Rgb colour(Cover cover, const Eigen::Vector3f& at_rest, const Eigen::Vector3f& normal_at_rest,
             float seen) const;

 private:
  Rgb round(const Texture& texture, const Eigen::Vector3f& at_rest, float seen) const;

  float height_;
  std::vector<Texture> textures_;  ///< by cover
  std::vector<Texture> print_;     ///< on the chest; one or none
};

}  // namespace stdc
