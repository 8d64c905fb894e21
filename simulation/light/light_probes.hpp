#pragma once

#include <array>
#include <vector>

#include "simulation/light/baked_light.hpp"

namespace stdc::simulation {

/// Irradiance at a point from the six directions of the axes: of a small surface that faces +x, -x, +y, ...
/// (the ambient cube of McTaggart, "Half-Life 2 / Valve Source shading", 2004).
struct LightCube {
  std::array<Rgb, 6> faces{};

  Rgb on(const Eigen::Vector3f& normal) const {
    const Eigen::Vector3f square = normal.cwiseAbs2();
    return square.x() * faces[normal.x() < 0 ? 1 : 0] + square.y() * faces[normal.y() < 0 ? 3 : 2] +
           square.z() * faces[normal.z() < 0 ? 5 : 4];
  }
};

/// The light in the free space of a room, on a lattice, for people and moving objects.
class LightProbes {
 public:
  LightProbes(const World& world, const BakedLight& light);

  /// Trilinear between the lattice points; outside the room, the value of the nearest point inside.
  LightCube at(const Eigen::Vector3f& position) const;

 private:
  Eigen::Vector3f low_, step_;
  Eigen::Vector3i size_;
  std::vector<LightCube> cubes_;
};

}  // namespace stdc::simulation
