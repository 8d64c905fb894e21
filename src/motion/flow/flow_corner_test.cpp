#include "motion/flow/flow_corner.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace stdc {
namespace {

SmallFrame frame_of(const cv::Mat& grey) {
  SmallFrame frame;
  shrink_frame(grey, cv::Mat(grey.size(), CV_16UC1, cv::Scalar(10000)), 5000, frame);
  return frame;
}

TEST(FlowCorner, FindsACornerAndNoEdge) {
  cv::Mat grey(120, 160, CV_8UC1, cv::Scalar(60));
  cv::rectangle(grey, {40, 40, 120, 80}, cv::Scalar(200), cv::FILLED);
  const SmallFrame frame = frame_of(grey);
  FlowCorner corner;
  EXPECT_TRUE(find_corner(frame, {38, 38, 4, 4}, corner));
  EXPECT_NEAR(corner.certainty(0, 1), 0, 0.3);
  EXPECT_FALSE(find_corner(frame, {80, 38, 4, 4}, corner)) << "an edge";
  EXPECT_FALSE(find_corner(frame, {10, 10, 4, 4}, corner)) << "nothing";
}

}  // namespace
}  // namespace stdc
