#include "motion/depth_noise.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

/// A frame of 10,000 cells of which one in a hundred is off by this share of the tolerance, and one in ten
/// moves.
DepthNoise::Frame frame_of(float gap) {
  DepthNoise::Frame frame;
  for (int i = 0; i < 10000; ++i) frame.add(i % 100 == 0 ? gap : i % 10 == 1 ? 3.0F : -0.1F);
  return frame;
}

float factor_after(double seconds, float gap) {
  DepthNoise noise;
  for (int i = 0; i <= 30 * seconds; ++i) noise.add(i / 30.0, frame_of(gap));
  return noise.factor();
}

TEST(DepthNoise, FollowsTheRecordingWithinBounds) {
  EXPECT_FLOAT_EQ(factor_after(3, 0.02F), 0.4F) << "less is not believed";
  EXPECT_NEAR(factor_after(3, 0.2F), 0.7F, 0.1F);
  EXPECT_FLOAT_EQ(factor_after(3, 0.7F), 1.0F);
}

TEST(DepthNoise, UntilASecondIsKnownAllIsTolerated) { EXPECT_FLOAT_EQ(factor_after(0.5, 0.02F), 1.0F); }

TEST(DepthNoise, WhatMovesDoesNotCountAndWhatBeginsToMoveNotAtOnce) {
  DepthNoise noise;
  for (int i = 0; i < 91; ++i) noise.add(i / 30.0, frame_of(0.1F));
  const float before = noise.factor();
  for (int i = 91; i < 105; ++i) noise.add(i / 30.0, frame_of(0.8F));
  EXPECT_FLOAT_EQ(noise.factor(), before);
  for (int i = 105; i < 120; ++i) noise.add(i / 30.0, frame_of(0.8F));
  EXPECT_FLOAT_EQ(noise.factor(), 1.0F);
}

}  // namespace
}  // namespace stdc
