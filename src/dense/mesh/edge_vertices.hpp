#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "dense/fusion/voxel_block.hpp"

namespace stdc {

/// Which of the 3 x 512 edges that begin at a block's voxels the surface crosses, and the number of the
/// vertex on each: a bit per edge and a running count per word, a fraction of what a table of numbers would
/// take.
class EdgeVertices {
 public:
  static constexpr int kEdges = 3 * VoxelBlock::kVoxels;

  void set(int edge) { words_[edge / 64] |= std::uint64_t{1} << (edge % 64); }
  void number(std::uint32_t first) {
    first_ = first;
    std::uint16_t count = 0;
    for (int word = 0; word < kWords; ++word) {
      before_[word] = count;
      count = static_cast<std::uint16_t>(count + std::popcount(words_[word]));
    }
  }
  std::uint32_t vertex(int edge) const {
    const std::uint64_t below = words_[edge / 64] & ((std::uint64_t{1} << (edge % 64)) - 1);
    return first_ + before_[edge / 64] + static_cast<std::uint32_t>(std::popcount(below));
  }

 private:
  static constexpr int kWords = kEdges / 64;
  std::array<std::uint64_t, kWords> words_{};
  std::array<std::uint16_t, kWords> before_{};
  std::uint32_t first_ = 0;
};

}  // namespace stdc
