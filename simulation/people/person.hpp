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
      : mesh(skeleton, appearance),
        textures(appearance),
        motion(skeleton, std::move(route), appearance.seed) {}
};

/// A random appearance; even and odd `number` differ in build and hair.
PersonAppearance random_appearance(int number, std::uint64_t seed);

}  // namespace stdc::simulation
