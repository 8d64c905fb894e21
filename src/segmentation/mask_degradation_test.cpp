#include "segmentation/mask_degradation.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/files/test_folder.hpp"

namespace stdc {
namespace {

cv::Mat square(int left = 40, int side = 80) {
  cv::Mat mask = cv::Mat::zeros(160, 200, CV_8UC1);
  mask(cv::Rect(left, 40, side, side)) = 1;
  return mask;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && (a.empty() || cv::norm(a, b, cv::NORM_L1) == 0);
}

TEST(Degrade, LeavesTheMaskAloneByDefault) { EXPECT_TRUE(same(degrade(square(), 3, {}), square() * 255)); }

TEST(Degrade, ErodesButNotAtTheEdgeOfTheImage) {
  const cv::Mat eroded = degrade(square(0), 0, {.erosion = 6});
  EXPECT_EQ(cv::countNonZero(eroded), (80 - 6) * (80 - 12));
  EXPECT_EQ(eroded.at<std::uint8_t>(80, 0), 255);
  EXPECT_EQ(eroded.at<std::uint8_t>(80, 73), 255);
  EXPECT_EQ(eroded.at<std::uint8_t>(80, 74), 0);
}

TEST(Degrade, MakesHolesThatDependOnSeedAndFrameOnly) {
  const MaskDegradationSettings settings{.holes = 4, .hole_radius = 10};
  const cv::Mat first = degrade(square(), 5, settings);
  EXPECT_TRUE(same(first, degrade(square(), 5, settings)));
  EXPECT_FALSE(same(first, degrade(square(), 6, settings)));
  EXPECT_FALSE(same(first, degrade(square(), 5, {.holes = 4, .hole_radius = 10, .seed = 2})));
  const int lost = 80 * 80 - cv::countNonZero(first);
  EXPECT_GT(lost, 60);  // a quarter of the smallest disc, were it at a corner
  EXPECT_LT(lost, 4 * 350);
  EXPECT_EQ(cv::countNonZero(first & (square() == 0)), 0);
  EXPECT_EQ(cv::countNonZero(degrade(cv::Mat::zeros(50, 50, CV_8UC1), 0, settings)), 0);
}

TEST(Degrade, EveryThirdIsMissing) {
  for (int frame = 0; frame < 9; ++frame) {
    EXPECT_EQ(degrade(square(), frame, {.missing_every = 3}).empty(), frame % 3 == 2) << frame;
  }
}

/// The square moves one pixel a frame.
class MovingSquare final : public Segmenter {
 public:
  cv::Mat segment(const SegmenterInput& input) override { return square(input.frame); }
};

TEST(DegradedSegmenter, GivesEarlierMasks) {
  DegradedSegmenter segmenter(std::make_unique<MovingSquare>(), {.missing_every = 5, .delay = 2});
  for (int frame = 0; frame < 12; ++frame) {
    const cv::Mat mask = segmenter.segment({cv::Mat(), 0.0, frame});
    if (frame < 2 || (frame - 2) % 5 == 4) {
      EXPECT_TRUE(mask.empty()) << frame;
    } else {
      EXPECT_TRUE(same(mask, square(frame - 2) * 255)) << frame;
    }
  }
}

TEST(DegradedSegmenter, RefusesSettingsOutOfRange) {
  EXPECT_NE(test::message_of([] {
              DegradedSegmenter(std::make_unique<MovingSquare>(), {.erosion = -1});
            }).find("degradation.erosion"),
            std::string::npos);
}

}  // namespace
}  // namespace stdc
