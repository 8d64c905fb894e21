#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "dense/mesh/triangle_mesh.hpp"

namespace stdc {

/// A triangle's share in what is looked for.
struct Facet {
  Eigen::Vector3d centre, normal;
  double area = 0;
};

/// The triangles of a mesh, of which one asks again and again for those that face somewhere. Holds their
/// normals roughly, in three bytes each: all else is worked out again for the few that may be meant, which
/// takes no longer than to fetch 56 bytes of each.
class Facets {
 public:
  explicit Facets(const TriangleMesh& mesh) : mesh_(mesh) {
    normals_.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Facet facet = facet_of(i);
      normals_.push_back({rough(facet.normal.x()), rough(facet.normal.y()), rough(facet.normal.z())});
    }
  }

  /// Calls use(facet) for those whose normal has at least this cosine to a unit vector, in the mesh's order.
  template <typename Use>
  void for_each_facing(const Eigen::Vector3d& direction, double min_cosine, const Use& use) const {
    constexpr double kError = 0.008;  // of a product with rough normals: 0.5 / kSteps * sqrt(3)
    const Eigen::Vector3f wanted = direction.cast<float>();
    const auto limit = static_cast<float>((min_cosine - kError) * kSteps);
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      const auto& [x, y, z] = normals_[i];
      if (wanted.x() * x + wanted.y() * y + wanted.z() * z < limit) continue;
      const Facet facet = facet_of(i);
      if (facet.area > 0 && !(facet.normal.dot(direction) < min_cosine)) use(facet);
    }
  }

 private:
  static constexpr double kSteps = 127;
  static std::int8_t rough(double value) { return static_cast<std::int8_t>(std::lround(kSteps * value)); }
  Facet facet_of(std::size_t triangle) const {
    const auto& corners = mesh_.triangles[triangle];
    const Eigen::Vector3d a = mesh_.positions[corners[0]].cast<double>(),
                          b = mesh_.positions[corners[1]].cast<double>(),
                          c = mesh_.positions[corners[2]].cast<double>();
    const Eigen::Vector3d cross = (b - a).cross(c - a);
    const double length = cross.norm();
    if (!(length > 0)) return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0};
    return {(a + b + c) / 3, cross / length, length / 2};
  }

  const TriangleMesh& mesh_;
  std::vector<std::array<std::int8_t, 3>> normals_;
};

}  // namespace stdc
