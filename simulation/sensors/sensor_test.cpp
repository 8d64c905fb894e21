#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "simulation/sensors/colour_sensor.hpp"
#include "simulation/sensors/depth_sensor.hpp"

namespace stdc {
namespace {

cv::Mat wall(float z) { return {480, 640, CV_32FC1, cv::Scalar(z)}; }
cv::Mat seen() { return {480, 640, CV_32FC1, cv::Scalar(0.9)}; }

/// Mean and standard deviation of the measured depths [m].
std::pair<double, double> statistics(const cv::Mat& depth) {
  cv::Mat metres;
  depth.convertTo(metres, CV_64F, 1 / 5000.0);
  cv::Scalar mean, deviation;
  cv::meanStdDev(metres, mean, deviation, depth > 0);
  return {mean[0], deviation[0]};
}

TEST(DepthSensor, NoiseGrowsWithTheSquareOfDepth) {
  const DepthSensor sensor{Camera()};
  const auto [near, near_noise] = statistics(sensor.image(wall(1.013F), seen(), 1));
  const auto [far, far_noise] = statistics(sensor.image(wall(3.04F), seen(), 2));
  EXPECT_NEAR(near, 1.013, 0.004);
  EXPECT_NEAR(far, 3.04, 0.02);
  EXPECT_NEAR(far_noise / near_noise, 9, 3);
  EXPECT_LT(near_noise, 0.005);
}

TEST(DepthSensor, DepthComesInStepsOfDisparity) {
  const DepthSensor sensor{Camera()};
  const cv::Mat depth = sensor.image(wall(3.0F), seen(), 1);
  std::vector<int> values;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) values.push_back(depth.at<std::uint16_t>(y, x));
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  EXPECT_LT(values.size(), 12U);
}

TEST(DepthSensor, HasHolesWhereThereIsNothingToMeasure) {
  const DepthSensor sensor{Camera()};
  EXPECT_EQ(cv::countNonZero(sensor.image(wall(0.4F), seen(), 1)), 0);
  EXPECT_EQ(cv::countNonZero(sensor.image(wall(7.0F), seen(), 1)), 0);
  EXPECT_EQ(cv::countNonZero(sensor.image(wall(0.0F), seen(), 1)), 0);
  EXPECT_EQ(cv::countNonZero(sensor.image(wall(2.0F), seen() * 0.05, 1)), 0);
  EXPECT_EQ(cv::countNonZero(sensor.image(wall(2.0F), seen(), 1)), 640 * 480);
  const int some = cv::countNonZero(sensor.image(wall(2.0F), seen() * 0.22, 1));
  EXPECT_GT(some, 640 * 480 / 10);
  EXPECT_LT(some, 640 * 480 * 9 / 10);
}

TEST(DepthSensor, ANearThingThrowsAShadowToItsLeft) {
  cv::Mat depth = wall(3.0F);
  depth(cv::Rect(300, 0, 100, 480)) = 1.0F;
  const cv::Mat image = DepthSensor{Camera()}.image(depth, seen(), 1);
  // The projector is 7.5 cm to the right: the shadow is b f (1/1 - 1/3) = 26 pixels wide.
  EXPECT_LT(cv::countNonZero(image(cv::Rect(278, 0, 20, 480))), 480);
  EXPECT_EQ(cv::countNonZero(image(cv::Rect(220, 0, 45, 480))), 45 * 480);
  EXPECT_EQ(cv::countNonZero(image(cv::Rect(410, 0, 60, 480))), 60 * 480);
}

TEST(ColourSensor, KeepsTheMeanAndAddsNoiseThatDependsOnTheSeed) {
  const ColourSensor sensor;
  const cv::Mat grey(480, 640, CV_32FC3, cv::Scalar(0.1, 0.2, 0.4));
  const cv::Mat image = sensor.image(grey, 1, 5);
  cv::Scalar mean, deviation;
  cv::meanStdDev(image(cv::Rect(280, 200, 80, 80)), mean, deviation);
  EXPECT_NEAR(mean[2], 255 * 0.349, 2);  // sRGB code of 0.1 light, red
  EXPECT_NEAR(mean[0], 255 * 0.665, 2);  // blue
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(deviation[c], 0.4);
    EXPECT_LT(deviation[c], 4);
  }
  EXPECT_EQ(cv::norm(image, sensor.image(grey, 1, 5), cv::NORM_INF), 0);
  EXPECT_NE(cv::norm(image, sensor.image(grey, 1, 6), cv::NORM_INF), 0);
  EXPECT_LT(cv::mean(image(cv::Rect(0, 0, 20, 20)))[1], mean[1] - 5);  // darker in the corner
}

}  // namespace
}  // namespace stdc
