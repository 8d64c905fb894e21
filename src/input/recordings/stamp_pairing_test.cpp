#include "input/recordings/stamp_pairing.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "input/association.hpp"

namespace stdc {
namespace {

using Pairs = std::vector<std::pair<std::int64_t, std::int64_t>>;

WaitingMessage at(std::int64_t stamp) { return {stamp, nullptr}; }

void take(StampPairing& pairing, Pairs& pairs) {
  while (const auto pair = pairing.next()) pairs.emplace_back(pair->first.stamp, pair->second.stamp);
}

/// Feeds both lists in the order of their stamps, depth delayed by `late`, and gives the pairs.
Pairs pairs_of(const std::vector<std::int64_t>& colour, const std::vector<std::int64_t>& depth,
               std::int64_t tolerance, std::int64_t late = 0) {
  StampPairing pairing(tolerance);
  Pairs pairs;
  for (std::size_t c = 0, d = 0; c < colour.size() || d < depth.size();) {
    if (d == depth.size() || (c < colour.size() && colour[c] <= depth[d] + late)) {
      pairing.add_colour(at(colour[c++]));
    } else {
      pairing.add_depth(at(depth[d++]));
    }
    take(pairing, pairs);
  }
  pairing.finish();
  take(pairing, pairs);
  return pairs;
}

TEST(StampPairing, PairsAtOnceWhatCanBePaired) {
  StampPairing pairing(10);
  pairing.add_depth(at(98));
  pairing.add_colour(at(100));
  EXPECT_FALSE(pairing.next().has_value());  // one at 101 would be nearer
  pairing.add_depth(at(130));
  const auto pair = pairing.next();
  ASSERT_TRUE(pair.has_value());
  EXPECT_EQ(pair->second.stamp, 98);
}

TEST(StampPairing, ADepthImageGoesToTheNearerColourImage) {
  EXPECT_EQ(pairs_of({100, 110}, {108}, 10), (Pairs{{110, 108}}));
  EXPECT_EQ(pairs_of({100, 110}, {94, 106}, 10), (Pairs{{100, 94}, {110, 106}}));
  EXPECT_EQ(pairs_of({100, 110}, {107, 110}, 10), (Pairs{{100, 107}, {110, 110}}));
  EXPECT_EQ(pairs_of({100, 200}, {150}, 10), (Pairs{}));
}

TEST(StampPairing, IsWhatPairingTheWholeListsWouldGive) {
  Random random(3);
  for (int run = 0; run < 200; ++run) {
    std::vector<std::int64_t> colour, depth;
    std::vector<double> colour_times, depth_times;
    for (int i = 0; i < 60; ++i) {
      // Frames are dropped, and both stamps jitter by a quarter of the period.
      if (random.below(8) != 0) colour.push_back(1000 * i + random.below(250));
      if (random.below(8) != 0) depth.push_back(1000 * i + 200 + random.below(250));
    }
    colour_times.assign(colour.begin(), colour.end());
    depth_times.assign(depth.begin(), depth.end());
    Pairs expected;
    for (const auto& [c, d] : associate_times(colour_times, depth_times, 500)) {
      expected.emplace_back(colour[static_cast<std::size_t>(c)], depth[static_cast<std::size_t>(d)]);
    }
    EXPECT_EQ(pairs_of(colour, depth, 500), expected);
    EXPECT_EQ(pairs_of(colour, depth, 500, 7000), expected);  // depth comes seven frames later
  }
}

TEST(StampPairing, GivesWayWhereNoMoreCanWait) {
  StampPairing pairing(10);
  for (int i = 0; i < 5; ++i) pairing.add_colour(at(100 * i));
  EXPECT_FALSE(pairing.next().has_value());
  pairing.give_way();
  EXPECT_FALSE(pairing.next().has_value());
  EXPECT_EQ(pairing.colour_without_depth(), 1);
  EXPECT_EQ(pairing.waiting(), 4U);
}

TEST(StampPairing, TakesAPartnerThatIsNearEnoughAtOnce) {
  StampPairing patient(20), live(20, 10);
  for (StampPairing* pairing : {&patient, &live}) {
    pairing->add_colour(at(100));
    pairing->add_depth(at(104));
  }
  EXPECT_FALSE(patient.next().has_value()) << "the next colour image may be nearer";
  const auto pair = live.next();
  ASSERT_TRUE(pair.has_value());
  EXPECT_EQ(pair->second.stamp, 104);
  live.add_colour(at(200));
  live.add_depth(at(215));
  EXPECT_FALSE(live.next().has_value());
}

}  // namespace
}  // namespace stdc
