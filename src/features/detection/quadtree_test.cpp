#include "features/detection/quadtree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/random.hpp"

namespace stdc {
namespace {

constexpr Cell kAreaTree{16, 16, 16 + 128, 16 + 96};
constexpr auto kHigh = KeypointQuality::high;
constexpr auto kLow = KeypointQuality::low;

Candidate candidate(int x, int y, KeypointQuality quality, float response) {
  return {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), 10, quality, response};
}

std::vector<Candidate> random_candidates(int count, double high_share, std::uint64_t seed) {
  Random random(seed);
  std::set<std::pair<int, int>> places;
  while (static_cast<int>(places.size()) < count) {
    // Crowded towards the top left.
    places.insert({kAreaTree.top + static_cast<int>(96 * random.uniform() * random.uniform()),
                   kAreaTree.left + static_cast<int>(128 * random.uniform() * random.uniform())});
  }
  std::vector<Candidate> candidates;
  for (const auto& [y, x] : places) {
    const auto quality = random.uniform() < high_share ? kHigh : kLow;
    const double response = quality == kHigh ? random.uniform(20, 100) : random.uniform(7, 20);
    candidates.push_back(candidate(x, y, quality, static_cast<float>(response)));
  }
  return candidates;
}

bool contains(const Cell& cell, const Candidate& c) {
  return c.x >= cell.left && c.x < cell.right && c.y >= cell.top && c.y < cell.bottom;
}

TEST(Quadtree, NothingGivesNothing) {
  Quadtree tree;
  EXPECT_TRUE(tree.select({}, kAreaTree, 10, Selection::improved).empty());
  const std::vector<Candidate> one{candidate(20, 20, kLow, 1)};
  EXPECT_TRUE(tree.select(one, kAreaTree, 0, Selection::improved).empty());
  EXPECT_EQ(tree.select(one, kAreaTree, 1, Selection::improved), std::vector{0});
  ASSERT_EQ(tree.cells().size(), 1U);
}

TEST(Quadtree, ANodeOfLowPointsIsNotSplit) {
  // Case 3: one winner of the four low points of the top left root, though there is budget for all.
  const std::vector<Candidate> candidates{candidate(20, 20, kLow, 1), candidate(60, 20, kLow, 4),
                                          candidate(20, 50, kLow, 2), candidate(60, 50, kLow, 3)};
  Quadtree tree;
  EXPECT_EQ(tree.select(candidates, kAreaTree, 100, Selection::improved), std::vector{1});
  EXPECT_EQ(tree.select(candidates, kAreaTree, 100, Selection::orb_slam3), (std::vector{0, 1, 2, 3}));
}

TEST(Quadtree, OneHighPointSplitsANode) {
  // Case 1: the root is split; then each child has one point.
  const std::vector<Candidate> candidates{candidate(20, 20, kLow, 1), candidate(60, 20, kHigh, 4),
                                          candidate(20, 50, kLow, 2), candidate(60, 50, kLow, 3)};
  Quadtree tree;
  EXPECT_EQ(tree.select(candidates, kAreaTree, 100, Selection::improved), (std::vector{0, 1, 2, 3}));
}

TEST(Quadtree, AHighPointIsSetApartFromItsLowNeighbours) {
  // Splitting goes on until the high point is alone; the low ones stay together wherever they are without it.
  const std::vector<Candidate> candidates{candidate(17, 16, kHigh, 1), candidate(60, 50, kLow, 3),
                                          candidate(62, 52, kLow, 2)};
  Quadtree tree;
  EXPECT_EQ(tree.select(candidates, kAreaTree, 100, Selection::improved), (std::vector{0, 1}));
}

TEST(Quadtree, LargestResponseWinsAndTheFirstOfEquals) {
  const std::vector<Candidate> candidates{candidate(20, 20, kLow, 2), candidate(21, 20, kLow, 5),
                                          candidate(30, 30, kLow, 5), candidate(40, 40, kLow, 1)};
  Quadtree tree;
  EXPECT_EQ(tree.select(candidates, kAreaTree, 100, Selection::improved), std::vector{1});
}

TEST(Quadtree, SeparatesNeighbouringPixels) {
  std::vector<Candidate> candidates;
  for (int y = 30; y < 37; ++y) {
    for (int x = 30; x < 37; ++x) candidates.push_back(candidate(x, y, kHigh, 1));
  }
  Quadtree tree;
  for (const Selection selection : {Selection::improved, Selection::orb_slam3}) {
    EXPECT_EQ(tree.select(candidates, kAreaTree, 1000, selection).size(), candidates.size());
  }
}

TEST(Quadtree, StopsAtTheBudget) {
  Quadtree tree;
  for (const Selection selection : {Selection::improved, Selection::orb_slam3}) {
    for (const int budget : {1, 2, 3, 4, 5, 17, 50, 99, 100, 150, 299}) {
      const std::vector<Candidate> candidates = random_candidates(300, 1.0, 7);
      const std::vector<int> winners = tree.select(candidates, kAreaTree, budget, selection);
      EXPECT_EQ(static_cast<int>(winners.size()), budget);
      EXPECT_TRUE(std::is_sorted(winners.begin(), winners.end()));
      EXPECT_EQ(std::set<int>(winners.begin(), winners.end()).size(), winners.size());
    }
  }
}

TEST(Quadtree, AWinnerIsTheBestOfItsCell) {
  Quadtree tree;
  for (const Selection selection : {Selection::improved, Selection::orb_slam3}) {
    const std::vector<Candidate> candidates = random_candidates(400, 0.3, 21);
    const std::vector<int> winners = tree.select(candidates, kAreaTree, 120, selection);
    ASSERT_EQ(tree.cells().size(), winners.size());
    for (std::size_t i = 0; i < winners.size(); ++i) {
      const Candidate& winner = candidates[static_cast<std::size_t>(winners[i])];
      const Cell& cell = tree.cells()[i];
      EXPECT_TRUE(contains(cell, winner));
      for (const Candidate& c : candidates) {
        if (contains(cell, c)) {
          EXPECT_LE(c.response, winner.response);
        }
      }
      for (std::size_t k = 0; k < i; ++k) {
        const Cell& other = tree.cells()[k];
        EXPECT_TRUE(cell.left >= other.right || other.left >= cell.right || cell.top >= other.bottom ||
                    other.top >= cell.bottom);
      }
    }
  }
}

TEST(Quadtree, CrowdedNodesAreSplitFirst) {
  // Budget for one split only: it goes to the root with the most points.
  std::vector<Candidate> candidates{candidate(20, 20, kHigh, 1), candidate(70, 20, kHigh, 2)};
  candidates.push_back(candidate(90, 20, kHigh, 1));
  candidates.push_back(candidate(140, 20, kHigh, 2));
  candidates.push_back(candidate(141, 60, kHigh, 3));
  Quadtree tree;
  EXPECT_EQ(tree.select(candidates, kAreaTree, 4, Selection::improved), (std::vector{1, 2, 3, 4}));
}

TEST(Quadtree, ImprovedKeepsMoreHighPointsThanClassic) {
  Quadtree tree;
  const std::vector<Candidate> candidates = random_candidates(500, 0.3, 5);
  const auto high = [&](Selection selection) {
    const std::vector<int>& winners = tree.select(candidates, kAreaTree, 150, selection);
    return std::count_if(winners.begin(), winners.end(),
                         [&](int i) { return candidates[static_cast<std::size_t>(i)].quality == kHigh; });
  };
  EXPECT_GT(high(Selection::improved), high(Selection::orb_slam3) + 10);
}

TEST(Quadtree, WideAndTallAreasHaveSquareRoots) {
  for (const Cell area : {Cell{0, 0, 400, 50}, Cell{0, 0, 50, 400}, Cell{3, 5, 7, 500}}) {
    std::vector<Candidate> candidates;
    for (int y = area.top; y < area.bottom; y += 2) {
      for (int x = area.left; x < area.right; x += 2) candidates.push_back(candidate(x, y, kLow, 1));
    }
    Quadtree tree;
    tree.select(candidates, area, 10000, Selection::improved);  // low points: the roots stay
    ASSERT_GE(tree.cells().size(), 4U);
    for (const Cell& cell : tree.cells()) {
      const double ratio = static_cast<double>(cell.right - cell.left) / (cell.bottom - cell.top);
      EXPECT_GT(ratio, 0.49);
      EXPECT_LT(ratio, 2.01);
    }
  }
}

}  // namespace
}  // namespace stdc
