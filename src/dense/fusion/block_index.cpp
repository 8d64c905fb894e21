#include "dense/fusion/block_index.hpp"

#include <algorithm>

namespace stdc {

std::size_t BlockIndex::slot_of(const BlockKey& key) const {
  // Large odd numbers, as in Teschner et al. 2003, and a last mixing: only the low bits are used.
  std::uint64_t hash = static_cast<std::uint32_t>(key.x) * 73856093ULL ^
                       static_cast<std::uint32_t>(key.y) * 19349663ULL ^
                       static_cast<std::uint32_t>(key.z) * 83492791ULL;
  hash *= 0x9E3779B97F4A7C15ULL;
  std::size_t slot = (hash >> 32U) & (slots_.size() - 1);
  while (slots_[slot] != kNone && keys_[slots_[slot]] != key) slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

std::uint32_t BlockIndex::find(const BlockKey& key) const { return slots_[slot_of(key)]; }

void BlockIndex::add(const BlockKey& key) {
  std::uint32_t& slot = slots_[slot_of(key)];
  if (slot != kNone) return;
  slot = static_cast<std::uint32_t>(keys_.size());
  keys_.push_back(key);
  if (2 * keys_.size() > slots_.size()) rebuild(2 * slots_.size());
}

void BlockIndex::rebuild(std::size_t slots) {
  slots_.assign(slots, kNone);
  for (std::size_t i = 0; i < keys_.size(); ++i) slots_[slot_of(keys_[i])] = static_cast<std::uint32_t>(i);
}

void BlockIndex::sort() {
  std::sort(keys_.begin(), keys_.end());
  rebuild(slots_.size());
}

std::size_t BlockIndex::end_of_layer(std::size_t block) const {
  const auto from = keys_.begin() + static_cast<std::ptrdiff_t>(block);
  const auto end = std::upper_bound(from, keys_.end(), from->x,
                                    [](std::int32_t x, const BlockKey& key) { return x < key.x; });
  return static_cast<std::size_t>(end - keys_.begin());
}

}  // namespace stdc
