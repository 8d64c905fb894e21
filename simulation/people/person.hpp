#pragma once

#include "simulation/people/body_mesh.hpp"
#include "simulation/people/person_motion.hpp"
#include "simulation/people/person_textures.hpp"

namespace stdc::simulation {

/// A person: body, clothes and motion.
struct Person {
  BodyMesh mesh;
  PersonTextures textures;
  PersonMotion motion;

  Person(const PersonAppearance& appearance, const Skeleton& skeleton, Route route)
      : Person(appearance, skeleton, std::move(route), appearance.seed) {}
  /// @param motion_seed  of the small motions in which people differ
  Person(const PersonAppearance& appearance, const Skeleton& skeleton, Route route, std::uint64_t motion_seed)
      : mesh(skeleton, appearance), textures(appearance), motion(skeleton, std::move(route), motion_seed) {}
};

/// A random appearance; even and odd `number` differ in build and hair.
PersonAppearance random_appearance(int number, std::uint64_t seed);

}  // namespace stdc::simulation
