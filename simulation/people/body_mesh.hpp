#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "simulation/people/body_pose.hpp"
#include "simulation/people/body_shape.hpp"
#include "simulation/scene/mesh.hpp"

namespace stdc::simulation {

/// The surface of a person, moved by the bones (linear blend skinning, Magnenat-Thalmann et al. 1988).
class BodyMesh {
 public:
  struct Vertex {
    Eigen::Vector3f position, normal;  ///< at rest
    std::array<std::uint8_t, 3> bones{};
    std::array<float, 3> weights{};  ///< sum is 1
    float sky_visibility =
        1;  ///< ambient occlusion by the body itself: share of the sky that is visible, 0..1
  };

  BodyMesh(const Skeleton& skeleton, const PersonAppearance& appearance);

  const std::vector<Vertex>& vertices() const { return vertices_; }
  const std::vector<std::array<std::uint32_t, 4>>& quads() const { return quads_; }
  const std::vector<BodyRegion>& regions() const { return regions_; }  ///< of the quads

  /// Appends the person in this pose to a mesh (positions, normals, quads; no patches, no texture
  /// coordinates).
  void append(const BodyPose& pose, Mesh& mesh) const;

 private:
  void add_part(const Skeleton& skeleton, const BodyPart& part);
  void find_sky_visibility();

  std::array<Eigen::Vector3f, kBones> joints_;
  std::vector<Vertex> vertices_;
  std::vector<std::array<std::uint32_t, 4>> quads_;
  std::vector<BodyRegion> regions_;
};

}  // namespace stdc::simulation
