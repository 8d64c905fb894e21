#include "simulation/sensors/colour_sensor.hpp"

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "simulation/scene/colour.hpp"

namespace stdc::simulation {
namespace {

constexpr int kSteps = 8192;                             // of the light table
constexpr int kNormals = 1024;                           // fits 10 bits of a random word
constexpr float kShotNoise = 7e-5F, kReadNoise = 2e-6F;  // variance = shot * light + read, light in 0..1
constexpr float kVignette = 0.16F;                       // loss of light in the corners

}  // namespace

ColourSensor::ColourSensor() {
  for (int i = 0; i < kSteps; ++i) {
    const float light = static_cast<float>(i) / (kSteps - 1);
    code_.push_back(255 * srgb_from_linear(light));
    const float slope =
        (srgb_from_linear(light + 0.002F) - srgb_from_linear(std::max(0.0F, light - 0.002F))) /
        (light < 0.002F ? light + 0.002F : 0.004F);
    sigma_.push_back(255 * std::min(slope, 6.0F) * std::sqrt(kShotNoise * light + kReadNoise));
  }
  Random random(1, 31);
  for (int i = 0; i < kNormals; ++i) normal_.push_back(static_cast<float>(random.normal()));
}

cv::Mat ColourSensor::image(const cv::Mat& linear, float exposure, std::uint64_t seed) const {
  cv::Mat result(linear.size(), CV_8UC3);
  const float centre_x = 0.5F * static_cast<float>(linear.cols - 1),
              centre_y = 0.5F * static_cast<float>(linear.rows - 1);
  const float corner = centre_x * centre_x + centre_y * centre_y;
  for (int y = 0; y < linear.rows; ++y) {
    Random random(seed, static_cast<std::uint64_t>(y) + 1);
    const auto* from = linear.ptr<cv::Vec3f>(y);
    auto* to = result.ptr<cv::Vec3b>(y);
    const float dy = static_cast<float>(y) - centre_y;
    for (int x = 0; x < linear.cols; ++x) {
      const float dx = static_cast<float>(x) - centre_x;
      const float gain = exposure * (1 - kVignette * (dx * dx + dy * dy) / corner) * (kSteps - 1);
      std::uint32_t bits = random.next();
      for (int c = 0; c < 3; ++c) {
        const auto step =
            static_cast<std::size_t>(std::clamp(from[x][2 - c] * gain, 0.0F, static_cast<float>(kSteps - 1)));
        const float code = code_[step] + sigma_[step] * normal_[bits & (kNormals - 1)];
        bits >>= 10U;
        to[x][c] = static_cast<std::uint8_t>(std::clamp(code + 0.5F, 0.0F, 255.0F));
      }
    }
  }
  return result;
}

}  // namespace stdc::simulation
