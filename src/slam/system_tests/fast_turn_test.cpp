// A turn so fast that no feature can be found in its images.
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "slam/system_tests/test_walk.hpp"

namespace stdc {
namespace {

constexpr int kStride = 5;   // places a frame
constexpr int kSmeared = 5;  // frames
constexpr int kFirst = 31;   // of them

Settings without_segmentation(bool direct_alignment) {
  Settings settings;
  settings.segmentation.source = SegmentationSource::off;
  settings.tracking.direct_alignment = direct_alignment;
  return settings;
}

void turn_fast(test::Walk& walk) {
  walk.go(0, kFirst - 1);
  const int from = kFirst - 1, to = from + kSmeared * kStride;
  for (int place = from + kStride; place <= to; place += kStride) {
    walk.see(place, [](RgbdImage& image) { cv::blur(image.colour, image.colour, {25, 1}); });
  }
  walk.go(to + 1, to + 10);
}

TEST(FastTurn, TheImagesAsAWholeTellThePose) {
  test::Walk walk(without_segmentation(true));
  turn_fast(walk);
  EXPECT_EQ(walk.count(TrackingStatus::lost), 0);
  for (std::size_t i = kFirst; i < kFirst + kSmeared; ++i) {
    EXPECT_EQ(walk.results[i].status, TrackingStatus::uncertain) << i;
  }
  EXPECT_EQ(walk.count(TrackingStatus::ok, kFirst + kSmeared), 10);
  for (const double error : walk.live_errors()) EXPECT_LT(error, 0.03);
}

TEST(FastTurn, FeaturesAloneAreLost) {
  test::Walk walk(without_segmentation(false));
  turn_fast(walk);
  EXPECT_EQ(walk.count(TrackingStatus::lost), kSmeared);
}

/// Each frame shows much that no keyframe has.
TEST(FastTurn, PointsOfTheLastFrameAloneMakeAKeyframe) {
  test::Walk walk(without_segmentation(true));
  for (int place = 0; place < 119; place += 10) walk.see(place);
  EXPECT_EQ(walk.count(TrackingStatus::lost), 0);
  EXPECT_TRUE(std::any_of(walk.results.begin(), walk.results.end(), [](const TrackingResult& result) {
    return result.status == TrackingStatus::uncertain && result.is_keyframe;
  }));
  for (const double error : walk.live_errors()) EXPECT_LT(error, 0.04);
}

}  // namespace
}  // namespace stdc
