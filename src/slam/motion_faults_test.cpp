// What the whole system makes of large things that move, without any segmentation: a pose that is called ok
// is right, and what cannot be known is said to be so.
#include <gtest/gtest.h>

#include <array>
#include <opencv2/imgproc.hpp>

#include "core/random.hpp"
#include "slam/test_walk.hpp"

namespace stdc {
namespace {

using test::Walk;

/// A textured board that faces the camera, pasted into frames with its depth.
class Board {
 public:
  /// `contrast`: of the texture, 1 = the whole range; a weak one gives fewer keypoints than the room has.
  Board(int width, int height, double depth, std::uint64_t seed, double contrast = 1)
      : depth_(depth), texture_(height, width, CV_8UC3) {
    Random random(seed);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        for (int c = 0; c < 3; ++c)
          texture_.at<cv::Vec3b>(y, x)[c] = static_cast<std::uint8_t>(random.below(256));
      }
    }
    cv::GaussianBlur(texture_, texture_, {}, 2);
    cv::normalize(texture_, texture_, 128 - 128 * contrast, 128 + 127 * contrast, cv::NORM_MINMAX);
  }
  /// Its left upper corner at that pixel. What lies nearer stays before it.
  void paste(RgbdImage& image, int left, int top) const {
    const double units = test::TestSequence::of_a_room().camera.depth_units_per_metre;
    const auto depth = static_cast<std::uint16_t>(depth_ * units);
    for (int y = std::max(top, 0); y < std::min(top + texture_.rows, image.colour.rows); ++y) {
      for (int x = std::max(left, 0); x < std::min(left + texture_.cols, image.colour.cols); ++x) {
        std::uint16_t& there = image.depth.at<std::uint16_t>(y, x);
        if (there != 0 && there < depth) continue;
        there = depth;
        image.colour.at<cv::Vec3b>(y, x) = texture_.at<cv::Vec3b>(y - top, x - left);
      }
    }
  }

 private:
  double depth_;
  cv::Mat texture_;
};

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
