#include "report/pictures/sample_frames.hpp"

#include <gtest/gtest.h>

#include "run/test_sequence.hpp"

namespace stdc::app {
namespace {

class Samples : public ::testing::Test {
 protected:
  Samples() : slam_(stdc::test::test_camera(), Settings()) {
    image_.colour = stdc::test::test_texture(600)(cv::Rect(0, 0, 320, 240));
    image_.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(10000));
  }
  void show(SampleFrames& samples, int index, TrackingStatus status = TrackingStatus::ok,
            double dynamic = 0) {
    TrackingResult result;
    result.frame = index;
    result.timestamp = index / 30.0;
    result.status = status;
    result.motion = MotionReport{};
    result.motion->dynamic_share = dynamic;
    samples.on_frame({100 + index, &image_, result});
  }
  Slam slam_;
  RgbdImage image_;
};

TEST_F(Samples, LieAtEvenDistances) {
  for (const std::optional<int> expected : {std::optional(300), std::optional<int>(), std::optional(20)}) {
    SampleFrames samples(slam_, expected);
    for (int i = 0; i < 300; ++i) show(samples, i);
    const std::vector<SampleFrame> frames = samples.frames();
    ASSERT_GE(frames.size(), 5U);
    ASSERT_LE(frames.size(), 9U);
    EXPECT_EQ(frames.front().number, 100);
    EXPECT_GE(frames.back().number, 340);
    for (std::size_t i = 2; i < frames.size(); ++i) {
      EXPECT_EQ(frames[i].number - frames[i - 1].number, frames[1].number - frames[0].number);
    }
  }
}

TEST_F(Samples, ShowWhereTrackingFailsAndWhereMostMoves) {
  SampleFrames samples(slam_, 300);
  for (int i = 0; i < 300; ++i) {
    show(samples, i, i >= 51 && i < 60 ? TrackingStatus::lost : TrackingStatus::ok, i == 121 ? 0.6 : 0.05);
  }
  std::vector<int> numbers;
  for (const SampleFrame& frame : samples.frames()) {
    numbers.push_back(frame.number);
    EXPECT_LT(frame.jpeg.size(), 61000U);
    if (frame.number == 151) {
      EXPECT_NE(frame.text.find("lost"), std::string::npos);
    }
    if (frame.number == 221) {
      EXPECT_NE(frame.text.find("60 % dynamic"), std::string::npos);
    }
  }
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 151), 1);
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 152), 0) << "the first of a stretch is enough";
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 221), 1);
}

TEST_F(Samples, LookAtDepth) {
  SampleFrames none(slam_, 10);
  EXPECT_FALSE(none.depth());
  SampleFrames samples(slam_, 10);
  image_.depth.rowRange(0, 120).setTo(cv::Scalar(0));
  show(samples, 0);
  ASSERT_TRUE(samples.depth());
  EXPECT_EQ(samples.depth()->median, 10000);
  EXPECT_NEAR(samples.depth()->valid_share, 0.5, 0.01);
  EXPECT_FALSE(samples.depth_in_metres());
}

}  // namespace
}  // namespace stdc::app
