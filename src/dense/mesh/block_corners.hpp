#pragma once

#include <array>
#include <cstdint>

#include "dense/fusion/distance_field.hpp"

namespace stdc {

/// The distances of a block and of the first layers of the blocks after it.
class BlockCorners {
 public:
  static constexpr float kUnknown = 1e9F;

  BlockCorners(const DistanceField& field, int min_weight) : field_(field), min_weight_(min_weight) {}

  void set_block(std::size_t block) {
    const BlockKey key = field_.blocks().keys()[block];
    for (int n = 0; n < 8; ++n) {
      neighbours_[n] = field_.blocks().find({key.x + (n & 1), key.y + (n >> 1 & 1), key.z + (n >> 2 & 1)});
    }
    inside_ = outside_ = false;
    for (int z = 0; z <= kSide; ++z) {
      for (int y = 0; y <= kSide; ++y) {
        for (int x = 0; x <= kSide; ++x) {
          const float value = fetch(x, y, z);
          values_[at(x, y, z)] = value;
          inside_ = inside_ || value < 0;
          outside_ = outside_ || (value >= 0 && value != kUnknown);
        }
      }
    }
  }
  /// Some values are on either side of the surface.
  bool may_hold_surface() const { return inside_ && outside_; }
  /// In units of the field; kUnknown where too little is known.
  float value(int x, int y, int z) const { return values_[at(x, y, z)]; }
  /// The block that has a voxel of this one or after it.
  std::uint32_t block_at(int x, int y, int z) const {
    return neighbours_[(x >= kSide ? 1 : 0) | (y >= kSide ? 2 : 0) | (z >= kSide ? 4 : 0)];
  }
  static int voxel(int x, int y, int z) { return ((z % kSide) * kSide + y % kSide) * kSide + x % kSide; }

 private:
  static constexpr int kSide = VoxelBlock::kSide;
  static int at(int x, int y, int z) { return (z * (kSide + 1) + y) * (kSide + 1) + x; }
  float fetch(int x, int y, int z) const {
    const std::uint32_t block = block_at(x, y, z);
    if (block == BlockIndex::kNone) return kUnknown;
    const int index = voxel(x, y, z);
    const int weight = field_.weights(block)[index];
    if (weight < min_weight_) return kUnknown;
    return static_cast<float>(field_.sums(block)[index]) / static_cast<float>(weight);
  }

  const DistanceField& field_;
  int min_weight_;
  std::array<std::uint32_t, 8> neighbours_{};
  std::array<float, (kSide + 1) * (kSide + 1) * (kSide + 1)> values_{};
  bool inside_ = false, outside_ = false;
};

}  // namespace stdc
