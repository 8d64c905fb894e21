#include "tracking/group_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stdc {
namespace {

/// Three seconds at 30 frames a second in which groups are off by so much [px].
GroupNoise three_seconds_of(double shift) {
  GroupNoise noise;
  for (int i = 0; i < 90; ++i) noise.add(i / 30.0, shift);
  return noise;
}

TEST(GroupNoise, TheThresholdFollowsTheRecording) {
  EXPECT_LT(three_seconds_of(0.08).threshold(3), 0.6);
  EXPECT_GT(three_seconds_of(0.12).threshold(3), 0.6);
  EXPECT_TRUE(std::isinf(three_seconds_of(0.3).threshold(3))) << "a camera in a hand";
}

TEST(GroupNoise, AtFirstNothingIsKnown) {
  GroupNoise noise;
  EXPECT_TRUE(std::isinf(noise.threshold(0)));
  noise.add(0, 0.05);
  EXPECT_TRUE(std::isinf(noise.threshold(0.1)));
  EXPECT_FALSE(std::isinf(noise.threshold(1)));
  noise.clear();
  EXPECT_TRUE(std::isinf(noise.threshold(1)));
}

TEST(GroupNoise, WhatBeginsToMoveNowDoesNotHideItself) {
  GroupNoise noise = three_seconds_of(0.08);
  const double before = noise.threshold(3);
  for (int i = 90; i < 105; ++i) noise.add(i / 30.0, 0.2);
  EXPECT_DOUBLE_EQ(noise.threshold(3.5), before);
}

TEST(GroupNoise, RemembersWhereGroupsWereOffInTheFrameBefore) {
  GroupNoise noise;
  const GroupPlace place{0, 1, 2, 3};
  noise.add(0, 0.1);
  noise.note_off(place);
  EXPECT_FALSE(noise.was_off(place)) << "in this frame, not before";
  noise.add(0, 0.2);
  EXPECT_FALSE(noise.was_off(place)) << "the same frame again";
  noise.add(0.1, 0.1);
  EXPECT_TRUE(noise.was_off(place));
  noise.add(0.2, 0.1);
  EXPECT_FALSE(noise.was_off(place)) << "two frames ago";
}

}  // namespace
}  // namespace stdc
