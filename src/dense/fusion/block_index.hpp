#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace stdc {

/// Place of a block of voxels, in blocks.
struct BlockKey {
  std::int32_t x = 0, y = 0, z = 0;
  auto operator<=>(const BlockKey&) const = default;
};

/// Blocks in a row: first .. last - 1.
struct BlockRange {
  std::size_t first = 0, last = 0;
  std::size_t size() const { return last - first; }
  bool contains(std::size_t block) const { return block >= first && block < last; }
};

/// A hash table from places to numbers 0, 1, ... (Niessner et al., 'Real-time 3D Reconstruction at Scale
/// using Voxel Hashing', SIGGRAPH Asia 2013): open addressing, linear probing. The order of the numbers is
/// that of adding, or of the places after sort(); never that of the hashes.
class BlockIndex {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  BlockIndex() : slots_(kFirstSlots, kNone) {}
  /// The number of a place; kNone if it was not added.
  std::uint32_t find(const BlockKey& key) const;
  void add(const BlockKey& key);
  /// Numbers the places in their own order.
  void sort();
  /// After sort(): the first block after a layer, which is all blocks with one x.
  std::size_t end_of_layer(std::size_t block) const;

  const std::vector<BlockKey>& keys() const { return keys_; }
  std::size_t size() const { return keys_.size(); }

 private:
  static constexpr std::size_t kFirstSlots = 1024;
  std::size_t slot_of(const BlockKey& key) const;
  void rebuild(std::size_t slots);

  std::vector<BlockKey> keys_;
  std::vector<std::uint32_t> slots_;  ///< a power of two of them, at most half of them taken
};

}  // namespace stdc
