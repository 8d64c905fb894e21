// What the whole system makes of faults in the middle of a sequence: every frame ends in a pose or a status,
// and tracking comes back to the map that it had.
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "slam/system_tests/test_walk.hpp"

namespace stdc {
namespace {

using test::kStep;
using test::Walk;

/// Frames of the room in any order, at fifteen a second.
void blacken(RgbdImage& image) { image.colour.setTo(0); }
void take_depth(RgbdImage& image) { image.depth.setTo(0); }

TEST(Faults, TwoBlackSeconds) {
  Walk walk;
  walk.go(0, 40);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(walk.see(40, blacken).status, TrackingStatus::lost);
  walk.go(40, 80);
  EXPECT_EQ(walk.count(TrackingStatus::ok, 41 + 30 + 2), 39) << "found again within three frames";
  EXPECT_EQ(walk.slam.maps(), 1);
  EXPECT_LT(walk.worst_error({0}, 0), 0.03);
}

TEST(Faults, CarriedToAnotherMappedPlace) {
  Walk walk;
  walk.go(0, 80);
  walk.go(20, 60);
  EXPECT_GE(walk.count(TrackingStatus::ok, 81), 41 - 3) << "found again within three frames";
  EXPECT_EQ(walk.slam.maps(), 1);
  EXPECT_LT(walk.worst_error({0}, 0), 0.03);
}

TEST(Faults, CarriedToAnUnknownPlaceAndBack) {
  Settings settings;
  settings.tracking.new_map_after = 5;
  Walk walk(settings);
  walk.go(0, 30);
  walk.go(100, 119);  // nothing in common with what is mapped
  EXPECT_EQ(walk.count(TrackingStatus::lost, 31), 6);
  EXPECT_EQ(walk.results.back().map, MapId{1}) << "a map of its own";
  EXPECT_EQ(walk.slam.maps(), 2);
  walk.go(10, 30);
  EXPECT_GE(walk.count(TrackingStatus::ok, 31 + 20), 21 - 3);
  EXPECT_EQ(walk.results.back().map, MapId{0}) << "back in the first";
  EXPECT_LT(walk.worst_error({0}, 0), 0.03);
  EXPECT_LT(walk.worst_error({1}, 106), 0.03);
}

TEST(Faults, MapsThatMeetBecomeOne) {
  Settings settings;
  settings.tracking.new_map_after = 5;
  Walk walk(settings);
  walk.go(0, 40);
  walk.go(100, 10);
  const bool merged = std::any_of(walk.results.begin(), walk.results.end(),
                                  [](const TrackingResult& r) { return r.loop && r.loop->merged; });
  EXPECT_TRUE(merged);
  EXPECT_EQ(walk.slam.maps(), 1);
  EXPECT_EQ(walk.results.back().map, MapId{0});
  EXPECT_EQ(walk.count(TrackingStatus::ok), 41 + 91 - 6) << "all but those that nobody could know";
  EXPECT_LT(walk.worst_error({0}, 0), 0.03) << "and all in the coordinates of the first";
}

/// Covers nine tenths of the view for a while.
class Curtain : public Segmenter {
 public:
  Curtain(int from, int to) : from_(from), to_(to) {}
  cv::Mat segment(const SegmenterInput& input) override {
    cv::Mat mask = cv::Mat::zeros(input.colour.size(), CV_8UC1);
    if (input.frame >= from_ && input.frame < to_) mask.colRange(0, mask.cols * 9 / 10) = 255;
    return mask;
  }

 private:
  int from_, to_;
};

TEST(Faults, NineTenthsOfTheViewAreCoveredForThreeSeconds) {
  Walk walk({}, std::make_unique<Curtain>(30, 75));
  walk.go(0, 104);
  EXPECT_EQ(walk.count(TrackingStatus::ok, 78), 27) << "found again within three frames";
  EXPECT_EQ(walk.slam.maps(), 1);
  EXPECT_LT(walk.worst_error({0}, 0), 0.03);
}

TEST(Faults, NoDepthForTwoSeconds) {
  Walk walk;
  walk.go(0, 30);
  walk.go(31, 60, take_depth);
  walk.go(61, 90);
  EXPECT_EQ(walk.count(TrackingStatus::ok), 91);
  EXPECT_EQ(walk.slam.maps(), 1);
  EXPECT_LT(walk.worst_error({0}, 0), 0.03);
}

TEST(Faults, FramesDroppedAndDoubledAndOutOfOrder) {
  Walk walk;
  walk.go(0, 20);
  walk.time += 3 * kStep;  // three are missing
  walk.go(24, 40);
  walk.see(40);  // the same image again, a moment later
  walk.time -= kStep;
  EXPECT_EQ(walk.see(40).status, TrackingStatus::skipped) << "the same frame twice";
  walk.time -= 4.5 * kStep;
  EXPECT_EQ(walk.see(38).status, TrackingStatus::skipped) << "older than the last";
  walk.time += 3.5 * kStep;
  walk.go(41, 60);
  EXPECT_EQ(walk.count(TrackingStatus::skipped), 2);
  EXPECT_EQ(walk.count(TrackingStatus::ok), static_cast<int>(walk.results.size()) - 2);
  EXPECT_EQ(walk.slam.maps(), 1);
  EXPECT_LT(walk.worst_error({0}, 0), 0.03);
}

}  // namespace
}  // namespace stdc
