#include "place_recognition/place_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.hpp"

namespace stdc {
namespace {

Descriptor any_descriptor(Random& random) {
  Descriptor descriptor;
  for (auto& word : descriptor.bits) word = (std::uint64_t{random.next()} << 32U) | random.next();
  return descriptor;
}

/// Rooms of corners, each seen from many spots: a view shows 200 of a place's 500 corners, with noise.
class Rooms {
 public:
  explicit Rooms(int places) {
    Random random(11);
    for (int p = 0; p < places; ++p) {
      for (int i = 0; i < kCorners; ++i) corners_.push_back(any_descriptor(random));
    }
  }
  std::vector<Descriptor> view(int place, std::uint64_t seed) const {
    Random random(seed);
    std::vector<Descriptor> seen;
    for (int i = 0; i < 200; ++i) {
      Descriptor d = corners_[static_cast<std::size_t>(place) * kCorners + random.below(kCorners)];
      for (int n = 0; n < 16; ++n) d.bits[random.below(4)] ^= std::uint64_t{1} << random.below(64);
      seen.push_back(d);
    }
    return seen;
  }

 private:
  static constexpr int kCorners = 500;
  std::vector<Descriptor> corners_;
};

KeyframeId id(std::size_t value) { return {static_cast<std::uint32_t>(value)}; }

/// Keyframe k shows place k % places.
PlaceIndex make_index(const Rooms& rooms, int places, int keyframes) {
  PlaceIndex index;
  for (int k = 0; k < keyframes; ++k) index.add(id(k), rooms.view(k % places, 100 + k));
  return index;
}

TEST(PlaceIndex, AnEmptyOneKnowsNoPlace) {
  const PlaceIndex index;
  const Rooms rooms(1);
  EXPECT_TRUE(index.query(rooms.view(0, 1), {}, 5).empty());
  EXPECT_FALSE(index.has(id(0)));
}

TEST(PlaceIndex, RanksTheKeyframesOfAPlaceBeforeAllOthers) {
  constexpr int kPlaces = 8, kKeyframes = 80;
  const Rooms rooms(kPlaces);
  const PlaceIndex index = make_index(rooms, kPlaces, kKeyframes);
  for (int place = 0; place < kPlaces; ++place) {
    const auto found = index.query(rooms.view(place, 7), {}, kKeyframes / kPlaces);
    ASSERT_EQ(found.size(), 10U);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(static_cast<int>(found[i].keyframe.value) % kPlaces, place);
      if (i > 0) {
        EXPECT_LE(found[i].score, found[i - 1].score);
      }
    }
    const auto all = index.query(rooms.view(place, 7), {}, 1000);
    for (const PlaceMatch& match : all) {
      if (static_cast<int>(match.keyframe.value) % kPlaces != place) {
        EXPECT_LT(match.score, found.back().score / 3);
      }
    }
  }
}

TEST(PlaceIndex, AScoreOfOneIsTheSameImageAlone) {
  const Rooms rooms(3);
  const PlaceIndex index = make_index(rooms, 3, 3);
  std::vector<Descriptor> view = rooms.view(1, 101);
  const auto found = index.query(view, {}, 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].keyframe, id(1));
  EXPECT_NEAR(found[0].score, 1, 0.01);
}

TEST(PlaceIndex, LeavesOutWhatIsExcluded) {
  const Rooms rooms(2);
  const PlaceIndex index = make_index(rooms, 2, 10);
  const auto before = index.query(rooms.view(0, 1), {}, 3);
  ASSERT_EQ(before.size(), 3U);
  const std::vector<KeyframeId> exclude{before[0].keyframe, before[2].keyframe, id(77)};
  const auto after = index.query(rooms.view(0, 1), exclude, 10);
  EXPECT_EQ(after.front().keyframe, before[1].keyframe);
  EXPECT_EQ(after.front().score, before[1].score) << "what is left out changes no other score";
  for (const PlaceMatch& match : after) {
    EXPECT_NE(match.keyframe, exclude[0]);
    EXPECT_NE(match.keyframe, exclude[1]);
  }
}

TEST(PlaceIndex, WhatIsRemovedIsNeverFoundAgain) {
  constexpr int kPlaces = 4, kKeyframes = 60;
  const Rooms rooms(kPlaces);
  PlaceIndex index = make_index(rooms, kPlaces, kKeyframes);
  Random random(2);
  std::vector<KeyframeId> left;
  left.reserve(kKeyframes);
  for (int k = 0; k < kKeyframes; ++k) left.push_back(id(k));
  while (left.size() > 1) {
    const auto place = left.begin() + random.below(static_cast<std::uint32_t>(left.size()));
    index.remove(*place);
    index.remove(*place);
    EXPECT_FALSE(index.has(*place));
    left.erase(place);
    EXPECT_EQ(index.keyframe_count(), static_cast<int>(left.size()));
    for (const PlaceMatch& match : index.query(rooms.view(0, 5), {}, 100)) {
      EXPECT_TRUE(std::find(left.begin(), left.end(), match.keyframe) != left.end());
    }
  }
  EXPECT_TRUE(index.has(left[0]));
  index.remove(left[0]);
  EXPECT_TRUE(index.query(rooms.view(0, 5), {}, 100).empty());
}

TEST(PlaceIndex, MemoryIsBoundedWhenKeyframesComeAndGo) {
  constexpr int kAlive = 40;
  const Rooms rooms(10);
  PlaceIndex index;
  std::size_t max_early = 0, max_late = 0;
  for (int k = 0; k < 1200; ++k) {
    index.add(id(k), rooms.view(k % 10, k));
    if (k >= kAlive) index.remove(id(k - kAlive));
    std::size_t& largest = k < 400 ? max_early : max_late;
    largest = std::max(largest, index.bytes());
  }
  EXPECT_EQ(index.keyframe_count(), kAlive);
  EXPECT_LT(max_late, max_early * 5 / 4);
  const auto found = index.query(rooms.view(3, 9999), {}, 4);
  ASSERT_EQ(found.size(), 4U);
  for (const PlaceMatch& match : found) {
    EXPECT_EQ(match.keyframe.value % 10, 3U);
    EXPECT_GE(match.keyframe.value, 1200U - kAlive);
  }
}

TEST(PlaceIndex, SameCallsSameAnswers) {
  const Rooms rooms(5);
  const PlaceIndex a = make_index(rooms, 5, 40), b = make_index(rooms, 5, 40);
  const auto of_a = a.query(rooms.view(2, 3), {}, 40), of_b = b.query(rooms.view(2, 3), {}, 40);
  ASSERT_EQ(of_a.size(), of_b.size());
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    EXPECT_EQ(of_a[i].keyframe, of_b[i].keyframe);
    EXPECT_EQ(of_a[i].score, of_b[i].score);
  }
}

TEST(PlaceIndex, ImagesWithoutKeypointsAreNowhere) {
  const Rooms rooms(1);
  PlaceIndex index;
  index.add(id(0), {});
  EXPECT_TRUE(index.query(rooms.view(0, 1), {}, 5).empty());
  index.add(id(1), rooms.view(0, 2));
  EXPECT_TRUE(index.query({}, {}, 5).empty());
  EXPECT_EQ(index.query(rooms.view(0, 1), {}, 5).size(), 1U);
  index.remove(id(0));
  EXPECT_EQ(index.keyframe_count(), 1);
}

}  // namespace
}  // namespace stdc
