#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace stdc {

/// Triangles with shared vertices. Counter-clockwise seen from the free side.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> positions;               ///< [m]
  std::vector<Eigen::Vector3f> normals;                 ///< unit vectors to the free side; as many
  std::vector<std::array<std::uint8_t, 3>> colours;     ///< red, green, blue; as many, or none
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of vertices

  bool empty() const { return triangles.empty(); }
};

/// Area of a triangle [m^2].
inline float area_of(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Eigen::Vector3f& a = mesh.positions[triangle[0]];
  return 0.5F * (mesh.positions[triangle[1]] - a).cross(mesh.positions[triangle[2]] - a).norm();
}

}  // namespace stdc
