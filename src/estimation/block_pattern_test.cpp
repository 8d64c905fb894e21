#include "estimation/block_pattern.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.hpp"
#include "estimation/kernels/kernels.hpp"

namespace stdc {
namespace {

struct alignas(64) Column {
  double value[kernels::kSegment];
};

double* plain(std::vector<Column>& list) { return reinterpret_cast<double*>(list.data()); }

/// A chain of `size` cameras, each connected to `reach` before it, and closed to a ring.
BlockPattern make_ring(std::size_t size, std::size_t reach) {
  BlockPattern pattern(size);
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t r = 1; r <= reach; ++r) pattern.connect(k, (k + r) % size);
  }
  return pattern;
}

/// A random positive definite matrix with a ring's pattern.
Eigen::MatrixXd make_matrix(std::size_t size, std::size_t reach) {
  const auto n = static_cast<Eigen::Index>(6 * size);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  Random random(3);
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t r = 1; r <= reach; ++r) {
      Eigen::MatrixXd j = Eigen::MatrixXd::Zero(6, n);
      for (int a = 0; a < 6; ++a) {
        for (int b = 0; b < 6; ++b) {
          j(a, static_cast<Eigen::Index>(6 * k) + b) = random.normal();
          j(a, static_cast<Eigen::Index>(6 * ((k + r) % size)) + b) = random.normal();
        }
      }
      matrix += j.transpose() * j;
    }
  }
  matrix.diagonal().array() += 0.1;
  return matrix;
}

void expect_solution(std::size_t size, std::size_t reach, bool reorder) {
  const Eigen::MatrixXd matrix = make_matrix(size, reach);
  BlockPattern pattern = make_ring(size, reach);
  std::vector<std::int32_t> order(size);
  std::iota(order.begin(), order.end(), 0);
  if (reorder) order = pattern.elimination_order();
  pattern = pattern.permuted(order);
  pattern.eliminate();
  std::vector<Column> blocks(6 * pattern.blocks()), x(size);
  Eigen::VectorXd right(6 * size);
  for (std::size_t j = 0; j < size; ++j) {
    for (std::size_t i = j; i < size; ++i) {
      const auto row = 6 * static_cast<Eigen::Index>(order[i]),
                 column = 6 * static_cast<Eigen::Index>(order[j]);
      const Eigen::Matrix<double, 6, 6> block = matrix.block<6, 6>(row, column);
      if (block.isZero(0)) continue;
      for (int c = 0; c < 6; ++c) {
        for (int r = 0; r < 6; ++r)
          blocks[6 * pattern.block(i, j) + static_cast<std::size_t>(c)].value[r] = block(r, c);
      }
    }
    for (int k = 0; k < 6; ++k) {
      x[j].value[k] = std::sin(static_cast<double>(order[j]) + 0.3 * k);
      right[6 * order[j] + k] = x[j].value[k];
    }
  }
  const kernels::BlockColumns columns{size, pattern.starts().data(), pattern.rows().data()};
  ASSERT_TRUE(kernels::best().factorise(columns, plain(blocks)));
  kernels::best().solve(columns, plain(blocks), plain(x));
  const Eigen::VectorXd expected = matrix.ldlt().solve(right);
  for (std::size_t j = 0; j < size; ++j) {
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(x[j].value[k], expected[6 * order[j] + k], 1e-9 * expected.norm());
  }
}

TEST(BlockPattern, SolvesASparseSystemInAnyOrder) {
  expect_solution(50, 3, true);
  expect_solution(50, 3, false);
}

TEST(BlockPattern, SolvesADenseSystem) { expect_solution(9, 8, true); }

TEST(BlockPattern, SolvesOneBlockAndNone) {
  expect_solution(1, 1, true);
  expect_solution(0, 0, true);
}

TEST(BlockPattern, OrderIsAPermutationThatKeepsAStarSparse) {
  // Eliminating the hub of a star first would fill the whole matrix.
  constexpr std::size_t kSize = 150;
  BlockPattern star(kSize);
  for (std::size_t k = 1; k < kSize; ++k) star.connect(0, k);
  std::vector<std::int32_t> order = star.elimination_order();
  BlockPattern good = star.permuted(order);
  good.eliminate();
  EXPECT_EQ(good.blocks(), 2 * kSize - 1);
  star.eliminate();
  EXPECT_EQ(star.blocks(), kSize * (kSize + 1) / 2);
  std::sort(order.begin(), order.end());
  for (std::size_t k = 0; k < kSize; ++k) EXPECT_EQ(order[k], static_cast<std::int32_t>(k));
}

TEST(BlockPattern, AnIndefiniteMatrixIsRefused) {
  BlockPattern pattern(2);
  pattern.connect(1, 0);
  pattern.eliminate();
  std::vector<Column> blocks(18);
  for (std::size_t k = 0; k < 6; ++k) {
    blocks[k].value[k] = 1;      // the diagonal
    blocks[6 + k].value[k] = 2;  // off it: makes the Schur complement 1 - 4
    blocks[12 + k].value[k] = 1;
  }
  const kernels::BlockColumns columns{2, pattern.starts().data(), pattern.rows().data()};
  EXPECT_FALSE(kernels::best().factorise(columns, plain(blocks)));
}

}  // namespace
}  // namespace stdc
