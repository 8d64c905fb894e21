#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "simulation/light/ray_scene.hpp"
#include "simulation/scene/world.hpp"

namespace stdc::simulation {

/// Irradiance of the static scene: soft shadows of the area lights, and ambient light from the walls with
/// ambient occlusion. Stored on a grid of nodes per patch; a node is computed when it is first needed, always
/// to the same value, so any number of threads may ask in any order.
class BakedLight {
 public:
  /// Keeps references to both.
  BakedLight(const World& world, const RayScene& scene);

  /// Light at (s, t) of a patch of the world's mesh; times the surface's colour it is what the camera sees.
  Rgb at(std::uint32_t patch, float s, float t) const;

  /// Irradiance of a small surface anywhere in free space; `seed` selects the sampling pattern.
  Rgb gather(const Eigen::Vector3f& position, const Eigen::Vector3f& normal, std::uint64_t seed) const;

 private:
  struct Grid {
    std::uint32_t first = 0;
    std::uint16_t columns = 1, rows = 1;  ///< cells; nodes are one more
  };
  std::uint64_t node(const Grid& grid, std::uint32_t patch, int column, int row) const;
  std::uint64_t compute(const Grid& grid, std::uint32_t patch, int column, int row,
                        std::uint32_t index) const;
  Rgb direct(const Eigen::Vector3f& position, const Eigen::Vector3f& normal, std::uint64_t seed) const;
  Rgb indirect(const Eigen::Vector3f& position, const Eigen::Vector3f& normal) const;

  const World& world_;
  const RayScene& scene_;
  std::vector<Grid> grids_;
  std::vector<Rgb> material_means_;
  std::vector<Eigen::Vector3f> hemisphere_;              ///< directions about the z axis
  std::unique_ptr<std::atomic<std::uint64_t>[]> nodes_;  ///< 0: not computed yet
};

}  // namespace stdc::simulation
