#include "dense/inpainting/depth_completion.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace stdc {
namespace {

TEST(DepthCompletion, FillsHolesSmoothlyAndKeepsWhatWasMeasured) {
  cv::Mat depth(61, 83, CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) depth.at<float>(y, x) = 2 + 0.005F * static_cast<float>(x);
  }
  const cv::Mat full = depth.clone();
  const cv::Rect hole(30, 20, 12, 10);
  depth(hole) = 0;
  complete_depth(depth);
  EXPECT_LT(cv::norm(depth(hole), full(hole), cv::NORM_INF), 0.03);
  depth(hole) = 0;
  cv::Mat kept = full.clone();
  kept(hole) = 0;
  EXPECT_EQ(cv::norm(depth, kept, cv::NORM_INF), 0);
}

TEST(DepthCompletion, LeansToTheFarSideOfAnEdge) {
  cv::Mat depth(64, 64, CV_32FC1, cv::Scalar(4));
  depth.colRange(0, 24) = 1;
  depth.colRange(24, 36) = 0;  // the shadow
  complete_depth(depth);
  EXPECT_GT(cv::mean(depth.colRange(26, 36))[0], 3);
}

TEST(DepthCompletion, LeavesAnImageWithoutDepthAlone) {
  cv::Mat depth(7, 5, CV_32FC1, cv::Scalar(0));
  complete_depth(depth);
  EXPECT_EQ(cv::countNonZero(depth), 0);
}

}  // namespace
}  // namespace stdc
