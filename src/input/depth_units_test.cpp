#include "input/depth_units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace stdc {
namespace {

TEST(DepthInUnits, RoundsMetresAndCountsWhatIsTooFar) {
  const cv::Mat metres = (cv::Mat_<float>(1, 6) << 1.00012F, 0, NAN, -1, 14, INFINITY);
  std::int64_t too_far = 0;
  const cv::Mat units = depth_in_units(metres, 5000, too_far);
  EXPECT_EQ(units.type(), CV_16UC1);
  EXPECT_EQ(units.at<std::uint16_t>(0, 0), 5001);
  EXPECT_EQ(cv::countNonZero(units), 1);
  EXPECT_EQ(too_far, 2);
  EXPECT_EQ(depth_in_units(units, 1000, too_far).data, units.data) << "units stay as they are";
}

}  // namespace
}  // namespace stdc
