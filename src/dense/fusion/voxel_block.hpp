#pragma once

namespace stdc {

/// A cube of voxels that is stored together.
struct VoxelBlock {
  static constexpr int kSide = 8;  ///< voxels along an edge
  static constexpr int kVoxels = kSide * kSide * kSide;
  static constexpr int kUnit = 1024;  ///< steps of distance between the surface and the truncation
};

}  // namespace stdc
