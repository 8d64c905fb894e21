#pragma once

#include <cstdint>
#include <vector>

#include "simulation/scene/material.hpp"
#include "simulation/scene/mesh.hpp"
#include "simulation/scene/texture.hpp"

namespace stdc::simulation {

/// A parallelogram that emits light to the side of s_edge x t_edge [m].
struct AreaLight {
  Eigen::Vector3f corner, s_edge, t_edge;
  Rgb radiance;  ///< a white surface under a uniform sky of radiance 1 has colour 1
};

/// The static scene: all that the camera can see except people and the objects they move. World frame:
/// metres, z up, floor at z = 0.
struct World {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  Mesh mesh;
  std::vector<AreaLight> lights;
  Eigen::Vector3f low = Eigen::Vector3f::Zero(),
                  high = Eigen::Vector3f::Zero();  ///< inner corners of the room
};

}  // namespace stdc::simulation
