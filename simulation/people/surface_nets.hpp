#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "simulation/people/solid.hpp"

namespace stdc::simulation {

/// A closed surface of quads, counter-clockwise seen from outside.
struct QuadSurface {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<std::array<std::uint32_t, 4>> quads;
};

/// The surface of a solid as quads of about `cell` side [m]: surface nets (Gibson 1998), with each vertex
/// projected onto the surface.
QuadSurface surface_of(const Solid& solid, float cell);

}  // namespace stdc::simulation
