// What the whole system makes of large things that move, without any segmentation: a pose that is called ok
// is right, and what cannot be known is said to be so.
#include <gtest/gtest.h>

#include <array>

#include "slam/system_tests/test_board.hpp"
#include "slam/system_tests/test_walk.hpp"

namespace stdc {
namespace {

using test::Board;
using test::Walk;

Settings without_segmentation() {
  Settings settings;
  settings.segmentation.source = SegmentationSource::off;
  return settings;
}

TEST(MotionFaults, ABoardSlidesOverMostOfTheView) {
  const Board board(240, 240, 0.9, 5);
  Walk walk(without_segmentation());
  walk.go(0, 20);
  for (int i = 0; i < 50; ++i) {
    const int place = i < 25 ? 21 + i : 70 - i;  // there and back: the end of it is in the map
    walk.see(place, [&](RgbdImage& image) { board.paste(image, -240 + 11 * i, 0); });
  }
  walk.go(21, 60);
  EXPECT_LT(walk.worst_error({0}, 0), 0.05) << "no pose that is called ok is wrong";
  EXPECT_GT(walk.count(TrackingStatus::ok), 90);
  EXPECT_EQ(walk.results.back().status, TrackingStatus::ok);
  EXPECT_EQ(walk.results.back().map, MapId{0});
}

TEST(MotionFaults, WithoutTheSearchForMotionTheBoardDeceives) {
  Settings settings = without_segmentation();
  settings.motion.method = MotionMethod::off;
  const Board board(240, 240, 0.9, 5);
  Walk walk(settings);
  walk.go(0, 20);
  for (int i = 0; i < 50; ++i) {
    walk.see(21 + i, [&](RgbdImage& image) { board.paste(image, -240 + 11 * i, 0); });
  }
  EXPECT_GT(walk.worst_error({0}, 0), 0.05) << "else the test above shows nothing";
}

// A map begins at once, with movers in it: those lose their landmarks as soon as they have moved. While the
// camera rests that is so after some frames; what nobody could tell is which of two things moves when the
// camera sets off in the first frame and a mover has more keypoints than the room.
TEST(MotionFaults, FirstFramesFullOfMovers) {
  const Board left(55, 150, 1.0, 6, 0.15), right(55, 150, 1.1, 7, 0.15);  // a quarter of the view
  Walk walk(without_segmentation());
  for (int i = 0; i < 60; ++i) {
    walk.see(std::max(0, i - 20), [&](RgbdImage& image) {
      left.paste(image, 20 + 5 * i, 40);
      right.paste(image, 210 - 4 * i, 30);
    });
  }
  walk.go(40, 80);
  EXPECT_LT(walk.worst_error({0}, 0), 0.05);
  EXPECT_GT(walk.count(TrackingStatus::ok), 95);
}

TEST(MotionFaults, AMoverThatStopsForGood) {
  const Board board(120, 160, 1.0, 8);
  Walk walk(without_segmentation());
  walk.go(0, 10);
  for (int i = 0; i < 20; ++i) {
    walk.see(10, [&](RgbdImage& image) { board.paste(image, -120 + 10 * i, 50); });
  }
  // The camera stays: then a thing at rest stays where it is in the image.
  for (int i = 0; i < 120; ++i) {
    walk.see(10, [&](RgbdImage& image) { board.paste(image, 80, 50); });
  }
  EXPECT_EQ(walk.count(TrackingStatus::ok), 11 + 140);
  EXPECT_LT(walk.worst_error({0}, 0), 0.05);
}

TEST(MotionFaults, TheCameraMovesWithTheMover) {
  const Board box(130, 110, 0.6, 9);
  Walk walk(without_segmentation());
  walk.go(0, 8);
  walk.go(9, 110, [&](RgbdImage& image) { box.paste(image, 0, 130); });
  EXPECT_EQ(walk.count(TrackingStatus::ok), 111);
  EXPECT_LT(walk.worst_error({0}, 0), 0.05);
}

TEST(MotionFaults, OneKeyframeAndThenABoard) {
  const Board board(48, 240, 0.9, 10);  // a seventh of the view
  Walk walk(without_segmentation());
  walk.go(0, 0);
  for (int i = 0; i < 40; ++i) {
    walk.see(1 + i, [&](RgbdImage& image) { board.paste(image, -48 + 9 * i, 0); });
  }
  walk.go(41, 80);
  EXPECT_LT(walk.worst_error({0}, 0), 0.05);
}

TEST(MotionFaults, TheViewIsBlockedAndFreeAgain) {
  const Board lid(320, 240, 0.55, 11);
  Walk walk(without_segmentation());
  walk.go(0, 30);
  for (int i = 0; i < 20; ++i) {
    const TrackingResult result = walk.see(30, [&](RgbdImage& image) { lid.paste(image, 0, 0); });
    EXPECT_NE(result.status, TrackingStatus::ok) << i;
  }
  walk.go(30, 60);
  EXPECT_EQ(walk.count(TrackingStatus::ok, 31 + 20 + 3), 31 - 3) << "found again within three frames";
  EXPECT_LT(walk.worst_error({0}, 0), 0.05);
}

// The last frame before the camera is lost need not show the most of what covers it.
TEST(MotionFaults, NoMapBeginsOnWhatCoveredTheViewShortlyBefore) {
  const Board board(240, 240, 0.9, 5), rest(70, 240, 0.9, 5), lid(320, 240, 0.55, 11);
  Walk walk(without_segmentation());
  walk.go(0, 20);
  for (int i = 0; i < 22; ++i) walk.see(21, [&](RgbdImage& image) { board.paste(image, -240 + 12 * i, 0); });
  for (int i = 0; i < 5; ++i) walk.see(21, [&](RgbdImage& image) { rest.paste(image, 30 + 12 * i, 0); });
  for (int i = 0; i < 60; ++i) {
    const TrackingResult result = walk.see(21, [&](RgbdImage& image) { lid.paste(image, 0, 0); });
    EXPECT_NE(result.status, TrackingStatus::ok) << i;
  }
  walk.go(21, 40);
  EXPECT_EQ(walk.results.back().status, TrackingStatus::ok);
  EXPECT_EQ(walk.results.back().map, MapId{0});
}

TEST(MotionFaults, WhatWasTakenAwayLosesItsLandmarks) {
  const Board box(100, 100, 1.0, 12);
  Walk walk(without_segmentation());
  const auto with_box = [&](RgbdImage& image) { box.paste(image, 110, 90); };
  for (int i = 0; i < 10; ++i) walk.see(0, with_box);
  walk.slam.finish();
  const auto near_landmarks = [&] {
    int count = 0;
    for (const Eigen::Vector3d& p : walk.slam.landmark_positions())
      count += std::abs(p.z() - 1) < 0.05 ? 1 : 0;
    return count;
  };
  EXPECT_GT(near_landmarks(), 20);
  for (int i = 0; i < 30; ++i) walk.see(0);
  walk.slam.finish();
  EXPECT_LT(near_landmarks(), 5);
}

// Boards pass all the time, each with another print: none of them may stay in the map.
TEST(MotionFaults, ABusyRoomDoesNotFillTheMap) {
  constexpr int kRounds = 6, kFar = 40;
  Walk walk(without_segmentation());
  walk.go(0, kFar);  // the map begins in peace
  walk.go(kFar - 1, 1);
  std::array<int, kRounds> landmarks{}, keyframes{};
  for (int round = 0; round < kRounds; ++round) {
    const Board left(70, 200, 1.0, 20 + round), right(60, 200, 1.2, 40 + round);
    int i = 0;
    const auto busy = [&](RgbdImage& image) {
      left.paste(image, -70 + 8 * (i % 50), 30);
      right.paste(image, 320 - 7 * (i % 55), 40);
      ++i;
    };
    walk.go(0, kFar, busy);
    walk.go(kFar - 1, 1, busy);
    walk.slam.finish();
    landmarks[round] = walk.slam.landmarks();
    keyframes[round] = walk.slam.keyframes();
  }
  EXPECT_LT(walk.worst_error({0}, 0), 0.05);
  EXPECT_LT(landmarks[kRounds - 1], 1.2 * landmarks[2]) << testing::PrintToString(landmarks);
  EXPECT_LT(keyframes[kRounds - 1], 1.2 * keyframes[2]) << testing::PrintToString(keyframes);
}

}  // namespace
}  // namespace stdc
