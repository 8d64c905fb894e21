#include "simulation/sensors/depth_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace stdc::simulation {
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

TEST(DepthSensor, NoiseIsThatOfKhoshelhamAndElberink) {
  // sigma_z = k z^2, with k = 1.4e-3 / m of a Kinect (Khoshelham and Elberink 2012, eq. 9 with their
  // calibration: 3.6 cm at 5 m). Averaged over a step of the disparity, because near the sensor the steps are
  // coarser than the noise.
  const DepthSensor sensor{Camera()};
  for (const float z : {1.0F, 2.0F, 3.0F, 4.0F}) {
    const float step = z * z / 348;
    double bias = 0, variance = 0;
    constexpr int kDepths = 6;
    for (int i = 0; i < kDepths; ++i) {
      const float truth = z + step * static_cast<float>(i) / kDepths;
      const auto [mean, sigma] = statistics(sensor.image(wall(truth), seen(), 1 + i));
      bias += (mean - truth) / kDepths;
      variance += (sigma * sigma + (mean - truth) * (mean - truth)) / kDepths;
    }
    EXPECT_NEAR(std::sqrt(variance) / (z * z), 1.35e-3, 0.3e-3) << z;
    EXPECT_NEAR(bias, 0, 0.1 * step) << z;
  }
}

TEST(DepthSensor, EveryDepthIsAWholeNumberOfDisparitySteps) {
  const cv::Mat depth = DepthSensor{Camera()}.image(wall(3.0F), seen(), 1);
  for (int y = 0; y < depth.rows; y += 7) {
    for (int x = 0; x < depth.cols; ++x) {
      const double steps = 348 * 5000.0 / depth.at<std::uint16_t>(y, x);  // baseline 0.075 m, 580 px, 1/8 px
      EXPECT_NEAR(steps, std::round(steps), 0.01);
    }
  }
}

TEST(DepthSensor, NoiseDependsOnTheSeedAlone) {
  const DepthSensor sensor{Camera()};
  const cv::Mat image = sensor.image(wall(2.0F), seen(), 5);
  EXPECT_EQ(cv::norm(image, sensor.image(wall(2.0F), seen(), 5), cv::NORM_INF), 0);
  EXPECT_NE(cv::norm(image, sensor.image(wall(2.0F), seen(), 6), cv::NORM_INF), 0);
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

TEST(DepthSensor, ANearObjectCastsAShadowToItsLeft) {
  cv::Mat depth = wall(3.0F);
  depth(cv::Rect(300, 0, 100, 480)) = 1.0F;
  const cv::Mat image = DepthSensor{Camera()}.image(depth, seen(), 1);
  // The projector is 7.5 cm to the right: the shadow is b f (1/1 - 1/3) = 26 pixels wide.
  EXPECT_LT(cv::countNonZero(image(cv::Rect(278, 0, 20, 480))), 480);
  EXPECT_EQ(cv::countNonZero(image(cv::Rect(220, 0, 45, 480))), 45 * 480);
  EXPECT_EQ(cv::countNonZero(image(cv::Rect(410, 0, 60, 480))), 60 * 480);
}

}  // namespace
}  // namespace stdc::simulation
