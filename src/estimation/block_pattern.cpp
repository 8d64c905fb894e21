#include "estimation/block_pattern.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <bit>
#include <numeric>

namespace stdc {
namespace {

// Up to this size a full factorisation takes less time than the search for an order.
constexpr std::size_t kSmall = 32;

}  // namespace

BlockPattern::BlockPattern(std::size_t size)
    : size_(size), words_((size + 63) / 64), bits_(size * words_, 0) {
  for (std::size_t k = 0; k < size; ++k) set(k, k);
}

void BlockPattern::connect(std::size_t a, std::size_t b) { set(std::max(a, b), std::min(a, b)); }

std::vector<std::int32_t> BlockPattern::elimination_order() const {
  std::vector<std::int32_t> order(size_);
  std::iota(order.begin(), order.end(), 0);
  std::size_t present = 0;
  for (const std::uint64_t word : bits_) present += static_cast<std::size_t>(std::popcount(word));
  if (size_ <= kSmall || 4 * present > size_ * size_) return order;  // small, or over half of the triangle

  std::vector<Eigen::Triplet<double, int>> entries;
  for (std::size_t column = 0; column < size_; ++column) {
    for (std::size_t row = column; row < size_; ++row) {
      if (!get(row, column)) continue;
      entries.emplace_back(static_cast<int>(row), static_cast<int>(column), 1.0);
      entries.emplace_back(static_cast<int>(column), static_cast<int>(row), 1.0);
    }
  }
  Eigen::SparseMatrix<double, Eigen::ColMajor, int> matrix(static_cast<Eigen::Index>(size_),
                                                           static_cast<Eigen::Index>(size_));
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(matrix, permutation);
  for (std::size_t k = 0; k < size_; ++k) order[k] = permutation.indices()[static_cast<Eigen::Index>(k)];
  return order;
}

BlockPattern BlockPattern::permuted(const std::vector<std::int32_t>& order) const {
  std::vector<std::size_t> place(size_);
  for (std::size_t k = 0; k < size_; ++k) place[static_cast<std::size_t>(order[k])] = k;
  BlockPattern result(size_);
  for (std::size_t column = 0; column < size_; ++column) {
    for (std::size_t row = column + 1; row < size_; ++row) {
      if (get(row, column)) result.connect(place[row], place[column]);
    }
  }
  return result;
}

void BlockPattern::eliminate() {
  // The rows of a column below its first one come to be in the column of that first row (the parent in the
  // elimination tree).
  for (std::size_t column = 0; column < size_; ++column) {
    std::size_t parent = column + 1;
    while (parent < size_ && !get(parent, column)) ++parent;
    if (parent == size_) continue;
    for (std::size_t w = parent / 64; w < words_; ++w) {
      std::uint64_t rows = bits_[column * words_ + w];
      if (w == parent / 64) rows &= ~std::uint64_t{0} << (parent % 64);
      bits_[parent * words_ + w] |= rows;
    }
  }
  starts_.assign(1, 0);
  rows_.clear();
  rank_.assign(bits_.size(), 0);
  for (std::size_t column = 0; column < size_; ++column) {
    for (std::size_t w = 0; w < words_; ++w) {
      rank_[column * words_ + w] = static_cast<std::uint32_t>(rows_.size());
      for (std::uint64_t rest = bits_[column * words_ + w]; rest != 0; rest &= rest - 1) {
        rows_.push_back(static_cast<std::int32_t>(64 * w) + std::countr_zero(rest));
      }
    }
    starts_.push_back(static_cast<std::uint32_t>(rows_.size()));
  }
}

std::uint32_t BlockPattern::block(std::size_t row, std::size_t column) const {
  const std::size_t w = column * words_ + row / 64;
  const std::uint64_t before = bits_[w] & ((std::uint64_t{1} << (row % 64)) - 1);
  return rank_[w] + static_cast<std::uint32_t>(std::popcount(before));
}

}  // namespace stdc
