#include "simulation/sensors/colour_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "simulation/scene/colour.hpp"

namespace stdc::simulation {
namespace {

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

TEST(ColourSensor, NoiseIsShotAndReadNoiseThroughTheSrgbCurve) {
  // Healey and Kondepudy (1994): the variance is linear in the light, here 7e-5 light + 2e-6.
  const ColourSensor sensor;
  for (const float light : {0.05F, 0.2F, 0.5F}) {
    const cv::Mat image = sensor.image(cv::Mat(480, 640, CV_32FC3, cv::Scalar::all(light)), 1, 7);
    cv::Scalar mean, deviation;
    cv::meanStdDev(image(cv::Rect(295, 215, 50, 50)), mean, deviation);
    const double slope = (srgb_from_linear(light + 1e-3F) - srgb_from_linear(light - 1e-3F)) / 2e-3;
    const double noise = 255 * slope * std::sqrt(7e-5 * light + 2e-6);
    const double expected = std::sqrt(noise * noise + 1.0 / 12);  // and the rounding to whole codes
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(deviation[c], expected, 0.12 * expected) << light << " " << c;
  }
}

}  // namespace
}  // namespace stdc::simulation
