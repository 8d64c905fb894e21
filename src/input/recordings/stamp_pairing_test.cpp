#include "input/recordings/stamp_pairing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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

/// What a live camera delivers: every image comes the moment it is taken.
struct LiveStreams {
  std::vector<std::int64_t> colour, depth;

  /// Depth lies `offset` from colour; both jitter; `rate` changes in the middle.
  LiveStreams(std::int64_t offset, std::int64_t jitter, std::uint32_t one_lost_in, std::int64_t period,
              std::int64_t later_period) {
    Random random(5);
    std::int64_t time = 1'000'000;
    for (int i = 0; i < 400; ++i) {
      time += i < 200 ? period : later_period;
      const auto jittered = [&] {
        return time + static_cast<std::int64_t>(random.below(static_cast<std::uint32_t>(1 + jitter)));
      };
      if (one_lost_in == 0 || random.below(one_lost_in) != 0) colour.push_back(jittered());
      if (one_lost_in == 0 || random.below(one_lost_in) != 0) depth.push_back(jittered() + offset);
    }
  }
};

/// How pairs were made: how long each waited since its later image, and the distance of its images.
struct LivePairs {
  std::vector<std::int64_t> waits, distances, colour;
};

LivePairs play(const LiveStreams& streams, StampPairing pairing) {
  LivePairs pairs;
  for (std::size_t c = 0, d = 0; c < streams.colour.size() || d < streams.depth.size();) {
    const bool colour_next =
        d == streams.depth.size() || (c < streams.colour.size() && streams.colour[c] <= streams.depth[d]);
    const std::int64_t now = colour_next ? streams.colour[c++] : streams.depth[d++];
    colour_next ? pairing.add_colour(at(now)) : pairing.add_depth(at(now));
    while (const auto pair = pairing.next()) {
      pairs.waits.push_back(now - std::max(pair->first.stamp, pair->second.stamp));
      pairs.distances.push_back(std::abs(pair->first.stamp - pair->second.stamp));
      pairs.colour.push_back(pair->first.stamp);
    }
  }
  return pairs;
}

double share_at_once(const LivePairs& pairs) {
  const auto waited = std::count_if(pairs.waits.begin(), pairs.waits.end(), [](auto w) { return w > 0; });
  return 1 - static_cast<double>(waited) / static_cast<double>(pairs.waits.size());
}

constexpr std::int64_t kTolerated = 20'000, kSoon = 10'000;  // [us]

TEST(StampPairing, LearnsThatNoNearerImageCanCome) {
  for (const std::int64_t offset : {-14'000, -12'000, 12'000, 14'000}) {
    const LiveStreams streams(offset, 0, 0, 33'000, 33'000);
    const LivePairs patient = play(streams, StampPairing(kTolerated));
    const LivePairs live = play(streams, StampPairing(kTolerated, kSoon));
    EXPECT_LT(share_at_once(patient), 0.1) << offset;
    EXPECT_GT(share_at_once(live), 0.96) << offset << ": all but the first ten, from which it learns";
    EXPECT_GE(live.colour.size(), patient.colour.size()) << offset;
    EXPECT_EQ(std::vector(live.distances.begin(), live.distances.begin() + 390),
              std::vector(patient.distances.begin(), patient.distances.begin() + 390));
  }
}

TEST(StampPairing, TakesNoPartnerThatIsMuchFurtherThanTheNearest) {
  constexpr std::int64_t kGain = kSoon / 4;
  struct Stream {
    std::int64_t jitter;
    std::uint32_t one_lost_in;
    std::int64_t period, later_period;
  };
  for (const auto& [jitter, lost, period, later] : {Stream{3'000, 0, 33'000, 33'000},
                                                    {3'000, 12, 33'000, 33'000},
                                                    {1'000, 0, 33'000, 66'000},
                                                    {1'000, 0, 66'000, 33'000},
                                                    {1'000, 0, 33'000, 11'000},
                                                    {6'000, 8, 33'000, 40'000}}) {
    for (std::int64_t offset = -18'000; offset <= 18'000; offset += 1'000) {
      const LiveStreams streams(offset, jitter, lost, period, later);
      const LivePairs live = play(streams, StampPairing(kTolerated, kSoon));
      int poor = 0;
      for (std::size_t i = 0; i < live.colour.size(); ++i) {
        std::int64_t nearest = kTolerated;
        for (const std::int64_t depth : streams.depth) {
          nearest = std::min(nearest, std::abs(depth - live.colour[i]));
        }
        if (live.distances[i] > kSoon && live.distances[i] > nearest + kGain) ++poor;
      }
      EXPECT_LE(poor, 0.06 * static_cast<double>(live.colour.size()))
          << "offset " << offset << ", jitter " << jitter << ", rate " << period << " to " << later;
    }
  }
}

TEST(StampPairing, LosesNoImageByHurry) {
  for (const std::int64_t offset : {-16'000, -13'000, 13'000, 16'000}) {
    const LiveStreams streams(offset, 4'000, 10, 33'000, 33'000);
    const LivePairs patient = play(streams, StampPairing(kTolerated));
    const LivePairs live = play(streams, StampPairing(kTolerated, kSoon));
    EXPECT_GE(static_cast<double>(live.colour.size()), 0.97 * static_cast<double>(patient.colour.size()))
        << offset;
    EXPECT_TRUE(std::is_sorted(live.colour.begin(), live.colour.end()));
  }
}

TEST(StampPairing, ACertainPairingLearnsNothing) {
  const LiveStreams streams(-12'000, 3'000, 9, 33'000, 20'000);
  const LivePairs live = play(streams, StampPairing(kTolerated));
  const Pairs expected = pairs_of(streams.colour, streams.depth, kTolerated);
  ASSERT_GE(live.colour.size() + 1, expected.size());
  for (std::size_t i = 0; i < live.colour.size(); ++i) EXPECT_EQ(live.colour[i], expected[i].first);
}

TEST(UsualInterval, IsNotMisledByAHiccup) {
  UsualInterval interval;
  for (int i = 0; i < 10; ++i) interval.add(33 * i);
  EXPECT_FALSE(interval.lower_bound().has_value()) << "too few";
  for (int i = 10; i < 40; ++i) interval.add(33 * i);
  interval.add(33 * 39 + 2);
  interval.add(33 * 40);
  EXPECT_EQ(interval.lower_bound(), 33);
  for (int i = 0; i < 4; ++i) interval.add(33 * 40 + 11 * (i + 1));
  EXPECT_EQ(interval.lower_bound(), 11) << "a faster stream is noticed within three images";
}

}  // namespace
}  // namespace stdc
