#include "features/detection/candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace stdc {
namespace {

constexpr Cell kArea{19, 19, 19 + 105, 19 + 70};  // 3 x 2 regions of 35 px
constexpr FeatureSettings kImproved{.selection = Selection::improved};
constexpr FeatureSettings kClassic{.selection = Selection::orb_slam3};

Corner corner(int x, int y, int score) {
  return {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), static_cast<std::uint8_t>(score)};
}

// Region 0: two high and one low; region 1: three low; region 2: one high; region 3: one low; rest: nothing.
const std::vector<Corner> kCorners{corner(20, 20, 30),  corner(60, 20, 8),  corner(70, 20, 15),
                                   corner(100, 20, 20), corner(22, 25, 19), corner(65, 30, 12),
                                   corner(25, 40, 90),  corner(30, 70, 7)};

std::vector<int> scores(const std::vector<Candidate>& candidates) {
  std::vector<int> result;
  for (const Candidate& c : candidates) result.push_back(c.score);
  return result;
}

TEST(Candidates, EnoughHighOnesNeedNoLowOnes) {
  CandidateChooser chooser;
  for (const int budget : {1, 2, 3}) {
    EXPECT_EQ(scores(chooser.choose(kCorners, kArea, budget, kImproved)), (std::vector{30, 20, 90}));
  }
}

TEST(Candidates, RegionsWithoutCandidatesGiveLowOnesFirst) {
  CandidateChooser chooser;
  // The strongest of region 1, then that of region 3: both have none. Then region 1 again (it has one, as
  // region 2 and 3, which have no more to give), then its last, and region 0 (two) the stronger first.
  EXPECT_EQ(scores(chooser.choose(kCorners, kArea, 4, kImproved)), (std::vector{30, 15, 20, 90}));
  EXPECT_EQ(scores(chooser.choose(kCorners, kArea, 5, kImproved)), (std::vector{30, 15, 20, 90, 7}));
  EXPECT_EQ(scores(chooser.choose(kCorners, kArea, 6, kImproved)), (std::vector{30, 15, 20, 12, 90, 7}));
  EXPECT_EQ(scores(chooser.choose(kCorners, kArea, 7, kImproved)), (std::vector{30, 15, 20, 19, 12, 90, 7}));
  EXPECT_EQ(scores(chooser.choose(kCorners, kArea, 8, kImproved)),
            (std::vector{30, 8, 15, 20, 19, 12, 90, 7}));
  EXPECT_EQ(chooser.choose(kCorners, kArea, 800, kImproved).size(), kCorners.size());
}

TEST(Candidates, ClassicTakesLowOnesOnlyInRegionsWithoutHighOnes) {
  CandidateChooser chooser;
  for (const int budget : {1, 100}) {
    EXPECT_EQ(scores(chooser.choose(kCorners, kArea, budget, kClassic)),
              (std::vector{30, 8, 15, 20, 12, 90, 7}));
  }
}

TEST(Candidates, QualityFollowsTheThreshold) {
  CandidateChooser chooser;
  for (const Candidate& c : chooser.choose(kCorners, kArea, 100, kImproved)) {
    EXPECT_EQ(c.quality == KeypointQuality::high, c.score >= 20);
    EXPECT_EQ(c.response, c.score);
  }
}

TEST(Candidates, NoCornersNoCandidates) {
  CandidateChooser chooser;
  EXPECT_TRUE(chooser.choose({}, kArea, 10, kImproved).empty());
  EXPECT_TRUE(chooser.choose({}, kArea, 10, kClassic).empty());
}

TEST(Candidates, LowOnesSpreadOverAllRegions) {
  // 50 low corners in each of 6 regions and budget for 60: ten of each.
  std::vector<Corner> corners;
  for (int y = 0; y < 10; ++y) {
    for (int row = 0; row < 2; ++row) {
      for (int x = 0; x < 15; ++x) {
        corners.push_back(
            corner(kArea.left + 7 * x + 3, kArea.top + 35 * row + 3 * y + 3, 7 + (x * 5 + y) % 13));
      }
    }
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.y < b.y; });
  CandidateChooser chooser;
  std::map<int, int> counts;
  for (const Candidate& c : chooser.choose(corners, kArea, 60, kImproved)) {
    ++counts[(c.y - kArea.top) / 35 * 3 + (c.x - kArea.left) / 35];
  }
  EXPECT_EQ(counts, (std::map<int, int>{{0, 10}, {1, 10}, {2, 10}, {3, 10}, {4, 10}, {5, 10}}));
}

}  // namespace
}  // namespace stdc
