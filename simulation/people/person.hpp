#pragma once

#include "simulation/people/body_mesh.hpp"
#include "simulation/people/person_motion.hpp"
#include "simulation/people/person_textures.hpp"

namespace stdc {

/// Somebody in the room: body, clothes and what they do.
struct Person {
  BodyMesh mesh;
  PersonTextures textures;
  PersonMotion motion;

  Person(const PersonLook& look, const BodyPlan& plan, Route route)
      : mesh(plan, look), textures(look), motion(plan, std::move(route), look.seed) {}
};

/// A look drawn at random; even and odd `number` differ in build and hair.
PersonLook random_look(int number, std::uint64_t seed);

}  // namespace stdc
