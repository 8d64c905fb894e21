#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>

#include "simulation/scene/mesh.hpp"

namespace stdc::simulation {

/// Where a ray hits a mesh: origin + distance * direction (the direction need not be a unit vector).
struct Hit {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  float distance = std::numeric_limits<float>::infinity();
  std::uint32_t quad = kNone;
  float u = 0, v = 0;  ///< within the quad, from its first vertex to the second (u) and to the fourth (v)

  bool valid() const { return quad != kNone; }
};

/// Quality of the bounding volume hierarchy: `fast` for meshes of one frame.
enum class TreeQuality { fast, good };

/// A mesh to trace rays against; tracing is thread-safe. Embree (Wald et al. 2014) finds the quad; distance,
/// u and v are computed here in double precision, so that they do not depend on the instruction set that
/// Embree uses.
class RayScene {
 public:
  static constexpr int kPacket = 8;

  /// Keeps a reference to `mesh`, which must stay as it is.
  RayScene(const Mesh& mesh, TreeQuality quality);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) = delete;

  /// Nearest hits of up to kPacket rays from one point. hits[i] holds the nearest hit known so far (its
  /// distance limits the search) and is replaced only by a nearer one.
  /// @return whether any was changed
  bool trace(const Eigen::Vector3f& origin, const Eigen::Vector3f* directions, int count, Hit* hits) const;
  /// Nearest hit of one ray between `near` and `far` (in multiples of the direction).
  Hit trace(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near, float far) const;
  /// Whether anything lies on the ray between 0 and `far`.
  bool occluded(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float far) const;

 private:
  struct Handles;
  void refine(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, std::uint32_t quad,
              bool second_half, Hit* hit) const;

  const Mesh* mesh_;
  std::unique_ptr<Handles> handles_;
};

}  // namespace stdc::simulation
