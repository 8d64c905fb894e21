#include "motion/depth_growth.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace stdc {
namespace {

constexpr int kWidth = 40, kHeight = 10;

std::size_t cell(int x, int y) { return static_cast<std::size_t>(y * kWidth + x); }

class DepthGrowthTest : public ::testing::Test {
 protected:
  std::vector<float> depth = std::vector<float>(kWidth * kHeight, 3);
  std::vector<GrowthSeed> seeds = std::vector<GrowthSeed>(kWidth * kHeight, GrowthSeed::none);

  int grown(const DepthGrowth& settings = {.reach = 100}) const {
    const auto cells = grow_in_depth(kWidth, kHeight, depth, seeds, settings);
    return std::accumulate(cells.begin(), cells.end(), 0);
  }
};

TEST_F(DepthGrowthTest, StopsAtDepthEdges) {
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 10; x < 15; ++x) depth[cell(x, y)] = 2;
  }
  seeds[cell(12, 4)] = GrowthSeed::moving;
  EXPECT_EQ(grown(), 5 * kHeight);
}

TEST_F(DepthGrowthTest, MeetsRestingSeedsHalfWay) {
  seeds[cell(0, 5)] = GrowthSeed::moving;
  seeds[cell(kWidth - 1, 5)] = GrowthSeed::resting;
  EXPECT_NEAR(grown(), kWidth * kHeight / 2, kHeight);
}

TEST_F(DepthGrowthTest, GoesNoFartherThanItsReach) {
  seeds[cell(0, 0)] = GrowthSeed::moving;
  EXPECT_EQ(grown({.reach = 3}), 10);  // 4 + 3 + 2 + 1
}

TEST_F(DepthGrowthTest, StaysNearTheDepthOfItsSeed) {
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) depth[cell(x, y)] = 2 + 0.05F * static_cast<float>(x);
  }
  seeds[cell(0, 0)] = GrowthSeed::moving;
  EXPECT_LE(grown(), 11 * kHeight);
}

TEST_F(DepthGrowthTest, TheMajorityAroundDecides) {
  seeds[cell(10, 5)] = GrowthSeed::moving;
  for (const int x : {9, 11}) seeds[cell(x, 5)] = GrowthSeed::resting;
  for (const int x : {29, 30, 31}) seeds[cell(x, 5)] = GrowthSeed::moving;
  const auto kept = keep_majority(kWidth, kHeight, depth, seeds, 3, 1);
  EXPECT_EQ(kept[cell(10, 5)], GrowthSeed::none);
  EXPECT_EQ(kept[cell(9, 5)], GrowthSeed::resting);
  EXPECT_EQ(kept[cell(30, 5)], GrowthSeed::moving);
}

TEST_F(DepthGrowthTest, KeepsThePatchesThatAreWanted) {
  std::vector<std::uint8_t> cells(depth.size(), 0);
  for (const int x : {3, 4, 20}) cells[cell(x, 5)] = 1;
  seeds[cell(4, 5)] = GrowthSeed::moving;
  keep_patches(
      kWidth, kHeight, seeds, cells, [](const MovingPatch& patch) { return patch.moving_seeds > 0; }, cells);
  EXPECT_EQ(cells[cell(3, 5)], 1);
  EXPECT_EQ(cells[cell(20, 5)], 0);
}

}  // namespace
}  // namespace stdc
