#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "simulation/people/solid.hpp"

namespace stdc {

/// A closed surface of quads that are seen from outside counter-clockwise.
struct Skin {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<std::array<std::uint32_t, 4>> quads;
};

/// The surface of a solid as quads of about `cell` side [m]: surface nets (Gibson 1998), then every vertex
/// drawn onto the surface.
Skin surface_of(const Solid& solid, float cell);

}  // namespace stdc
