#pragma once

#include <cstdint>
#include <vector>

namespace stdc {

/// Which 6x6 blocks of a symmetric block matrix are not zero, and, once `eliminate` has run, which ones of
/// its Cholesky factor. A dense matrix is the case where all are.
class BlockPattern {
 public:
  /// A matrix of `size` block rows with only its diagonal.
  explicit BlockPattern(std::size_t size);

  std::size_t size() const { return size_; }
  /// Says that the blocks (a, b) and (b, a) are not zero.
  void connect(std::size_t a, std::size_t b);
  /// The order in which elimination makes few new blocks (approximate minimum degree: Amestoy, Davis and
  /// Duff, SIAM J. Matrix Anal. 1996): result[k] is the k-th row to eliminate. The given order where that is
  /// no worse: small or nearly full patterns.
  std::vector<std::int32_t> elimination_order() const;
  /// The same pattern with row order[k] as row k.
  BlockPattern permuted(const std::vector<std::int32_t>& order) const;

  /// Adds the blocks that a Cholesky factorisation fills and numbers those of the lower triangle by columns.
  void eliminate();
  /// After `eliminate`: the number of a block, row >= column; it must be in the pattern.
  std::uint32_t block(std::size_t row, std::size_t column) const;
  std::size_t blocks() const { return rows_.size(); }
  /// First block of each column, and the end.
  const std::vector<std::uint32_t>& starts() const { return starts_; }
  /// Row of each block; ascending in a column, whose first is the diagonal.
  const std::vector<std::int32_t>& rows() const { return rows_; }

 private:
  bool get(std::size_t row, std::size_t column) const {
    return (bits_[column * words_ + row / 64] >> (row % 64) & 1U) != 0;
  }
  void set(std::size_t row, std::size_t column) {
    bits_[column * words_ + row / 64] |= std::uint64_t{1} << (row % 64);
  }

  std::size_t size_, words_;
  std::vector<std::uint64_t> bits_;  // column by column; rows above the diagonal stay 0
  std::vector<std::uint32_t> starts_, rank_;
  std::vector<std::int32_t> rows_;
};

}  // namespace stdc
