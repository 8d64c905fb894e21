#include "segmentation/propagation/mask_settling.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/files/test_folder.hpp"
#include "segmentation/propagation/test_stage.hpp"
#include "segmentation/srm/refinement.hpp"

namespace stdc {
namespace {

using test::kUnits;

const cv::Rect kBody(203, 101, 151, 262);

cv::Mat depth_image(int type) {
  cv::Mat depth(480, 640, CV_32FC1, cv::Scalar(3.0));
  depth(kBody) = cv::Scalar(1.5);
  if (type == CV_16UC1) depth.convertTo(depth, type, kUnits);
  return depth;
}

cv::Mat mask_of(cv::Rect rect) {
  cv::Mat mask = cv::Mat::zeros(480, 640, CV_8UC1);
  mask(rect) = 1;
  return mask;
}

cv::Rect grown(int by) { return {kBody.x - by, kBody.y - by, kBody.width + 2 * by, kBody.height + 2 * by}; }

int differing(const cv::Mat& a, const cv::Mat& b) { return cv::countNonZero((a != 0) != (b != 0)); }

TEST(SettleByDepth, CorrectsARimOnEitherSide) {
  for (const int type : {CV_16UC1, CV_32FC1}) {
    const cv::Mat depth = depth_image(type), truth = mask_of(kBody);
    for (int by = -4; by <= 4; ++by) {
      const cv::Mat settled = settle_by_depth(mask_of(grown(by)), depth, kUnits);
      EXPECT_EQ(settled.type(), CV_8UC1);
      EXPECT_EQ(differing(settled, truth), 0) << by;
      EXPECT_EQ(differing(refine(settled, depth, kUnits), truth), 0) << by;
    }
    // What it is good for: the fringe that refinement makes of one pixel too many.
    EXPECT_GT(differing(refine(mask_of(grown(1)), depth, kUnits), truth), 8 * 800);
  }
}

TEST(SettleByDepth, LeavesPixelsWithoutDepthAlone) {
  cv::Mat depth = depth_image(CV_16UC1);
  const cv::Rect shadow(kBody.br().x - 3, kBody.y, 12, kBody.height);
  depth(shadow) = 0;
  const cv::Mat settled = settle_by_depth(mask_of(grown(2)), depth, kUnits);
  EXPECT_EQ(differing(settled(shadow), mask_of(grown(2))(shadow)), 0);
  EXPECT_EQ(cv::countNonZero(settle_by_depth(mask_of(kBody), cv::Mat::zeros(480, 640, CV_16UC1), kUnits)),
            kBody.area());
}

TEST(SettleByDepth, AThinThingStays) {
  cv::Mat depth = depth_image(CV_16UC1);
  const cv::Rect pole(100, 50, 6, 300);
  depth(pole) = 2 * kUnits;
  EXPECT_EQ(differing(settle_by_depth(mask_of(pole), depth, kUnits), mask_of(pole)), 0);
}

TEST(SettleByDepth, NothingStaysNothing) {
  EXPECT_EQ(cv::countNonZero(settle_by_depth(mask_of({}), depth_image(CV_16UC1), kUnits)), 0);
  EXPECT_NE(test::message_of([] { settle_by_depth(cv::Mat(), depth_image(CV_16UC1), kUnits); }), "");
}

}  // namespace
}  // namespace stdc
