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
///
/// It knows where all blocks are, but has voxels for some only, at 3 kB a block: what is made of it is made
/// of a part after the other (field_windows.hpp).
class DistanceField {
 public:
  static constexpr int kSide = VoxelBlock::kSide;
  static constexpr int kVoxels = VoxelBlock::kVoxels;
  static constexpr int kUnit = VoxelBlock::kUnit;

  /// @param voxel       side of a voxel [m]
  /// @param truncation  distance from a surface at which the field ends [m]
  DistanceField(float voxel, float truncation) : voxel_(voxel), truncation_(truncation) {}

  /// Notes that there is a surface where a view sees one. Before sort_blocks().
  void mark(const ViewSamples& view, const Pose& world_from_cam);
  /// Puts the blocks around all that was marked in their order.
  void sort_blocks() { blocks_.sort(); }
  /// Takes memory for the voxels of so many blocks.
  void reserve(std::size_t blocks);
  /// Has voxels for these blocks from now on: those that it had keep theirs, of the others nothing is known.
  /// The range may move forwards only.
  void hold(BlockRange blocks);
  /// Whether a view may tell something of any of these blocks.
  /// @param view  only its camera and the farthest depths of its tiles are looked at
  bool concerns(const ViewSamples& view, const Pose& cam_from_world, BlockRange blocks) const;
  /// Puts what a view tells into blocks that are held: distances around its surface, and that what lies
  /// before it is free. Calls for different blocks may run at the same time.
  void integrate(const ViewSamples& view, const Pose& cam_from_world, BlockRange blocks);

  float voxel() const { return voxel_; }
  float truncation() const { return truncation_; }
  const BlockIndex& blocks() const { return blocks_; }
  BlockRange held() const { return held_; }
  /// Of a block that is held, by (z * kSide + y) * kSide + x. Distance = sum / weight / kUnit * truncation,
  /// positive where it is free.
  std::span<const std::int32_t> sums(std::size_t block) const {
    return {sums_.data() + (block - held_.first) * kVoxels, static_cast<std::size_t>(kVoxels)};
  }
  std::span<const std::uint16_t> weights(std::size_t block) const {
    return {weights_.data() + (block - held_.first) * kVoxels, static_cast<std::size_t>(kVoxels)};
  }
  /// Centre of a block's first voxel [m, world].
  Eigen::Vector3f origin(const BlockKey& key) const {
    return Eigen::Vector3f(static_cast<float>(key.x), static_cast<float>(key.y), static_cast<float>(key.z)) *
           (kSide * voxel_);
  }

 private:
  float voxel_, truncation_;
  BlockIndex blocks_;
  BlockRange held_;
  std::vector<std::int32_t> sums_;
  std::vector<std::uint16_t> weights_;
};

}  // namespace stdc
