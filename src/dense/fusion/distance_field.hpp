#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "dense/fusion/block_index.hpp"
#include "dense/fusion/view_samples.hpp"
#include "dense/fusion/voxel_block.hpp"

namespace stdc {

/// A truncated signed distance field (Curless and Levoy, 'A Volumetric Method for Building Complex Models
/// from Range Images', SIGGRAPH 1996) in hashed blocks of voxels.
///
/// A voxel holds the sum of weighted distances and the sum of the weights, both as integers. So the field
/// does not depend on the order in which views come, nor on threads or instruction sets: it is the same, to
/// the bit, for the same views and poses.
class DistanceField {
 public:
  static constexpr int kSide = VoxelBlock::kSide;
  static constexpr int kVoxels = VoxelBlock::kVoxels;
  static constexpr int kUnit = VoxelBlock::kUnit;

  /// @param voxel       side of a voxel [m]
  /// @param truncation  distance from a surface at which the field ends [m]
  DistanceField(float voxel, float truncation) : voxel_(voxel), truncation_(truncation) {}

  /// Notes that there is a surface where a view sees one. Before allocate().
  void mark(const ViewSamples& view, const Pose& world_from_cam);
  /// Makes the voxels around all that was marked.
  void allocate();
  /// Puts what a view tells into the blocks first .. last - 1: distances around its surface, and that what
  /// lies before it is free. Calls for different blocks may run at the same time.
  void integrate(const ViewSamples& view, const Pose& cam_from_world, std::size_t first, std::size_t last);

  float voxel() const { return voxel_; }
  float truncation() const { return truncation_; }
  const BlockIndex& blocks() const { return blocks_; }
  /// Of a block, by (z * kSide + y) * kSide + x. Distance = sum / weight / kUnit * truncation, positive where
  /// it is free.
  std::span<const std::int32_t> sums(std::size_t block) const {
    return {sums_.data() + block * kVoxels, static_cast<std::size_t>(kVoxels)};
  }
  std::span<const std::uint16_t> weights(std::size_t block) const {
    return {weights_.data() + block * kVoxels, static_cast<std::size_t>(kVoxels)};
  }
  /// Centre of a block's first voxel [m, world].
  Eigen::Vector3f origin(const BlockKey& key) const {
    return Eigen::Vector3f(static_cast<float>(key.x), static_cast<float>(key.y), static_cast<float>(key.z)) *
           (kSide * voxel_);
  }

 private:
  float voxel_, truncation_;
  BlockIndex blocks_;
  std::vector<std::int32_t> sums_;
  std::vector<std::uint16_t> weights_;
};

}  // namespace stdc
