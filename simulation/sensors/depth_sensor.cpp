#include "simulation/sensors/depth_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.hpp"

namespace stdc::simulation {
namespace {

constexpr float kBaseline = 0.075F;     // between the projector and the infrared camera [m]
constexpr float kFocal = 580.0F;        // of the infrared camera [px]
constexpr float kStepsPerPixel = 8.0F;  // of disparity
constexpr float kMinDepth = 0.5F, kReliableDepth = 4.2F, kMaxDepth = 6.0F;  // [m]
constexpr float kNoise = 0.45F;                                             // of the disparity, in steps
constexpr float kOutline = 0.6F;         // jitter of the pixel position [px]
constexpr float kMinInfrared = 0.08F;    // less infrared than this is never measured ...
constexpr float kMedianInfrared = 0.2F;  // ... and about this much half of the time
constexpr int kCell = 4;                 // correlation length of the noise, from the matcher's window [px]

/// Noise that is correlated between neighbouring pixels, as from the sensor's block matcher: one normal value
/// per cell corner, bilinear between.
class CellNoise {
 public:
  CellNoise(int width, int height, std::uint64_t seed, std::uint64_t stream)
      : columns_(width / kCell + 2), values_(static_cast<std::size_t>(columns_) * (height / kCell + 2)) {
    Random random(seed, stream);
    for (float& value : values_) {
      // Sum of four uniform values: normal enough, and cheaper.
      const std::uint32_t a = random.next();
      const float sum =
          static_cast<float>((a & 255U) + ((a >> 8U) & 255U) + ((a >> 16U) & 255U) + (a >> 24U));
      value = (sum - 510.0F) * (1.0F / 147.8F);
    }
  }
  float at(int x, int y) const {
    const int column = x / kCell, row = y / kCell;
    const float fx = static_cast<float>(x % kCell) / kCell, fy = static_cast<float>(y % kCell) / kCell;
    const float* top = values_.data() + static_cast<std::size_t>(row) * columns_ + column;
    const float* bottom = top + columns_;
    return (top[0] * (1 - fx) + top[1] * fx) * (1 - fy) + (bottom[0] * (1 - fx) + bottom[1] * fx) * fy;
  }

 private:
  int columns_;
  std::vector<float> values_;
};

}  // namespace

cv::Mat DepthSensor::lit_by_projector(const cv::Mat& depth) const {
  // The projector stands to the right of the camera: along a row from the right, a point that projects no
  // farther left than an earlier one lies in its shadow.
  cv::Mat lit(depth.size(), CV_8UC1);
  const auto shift = static_cast<float>(camera_.fx) * kBaseline;
  for (int y = 0; y < depth.rows; ++y) {
    const auto* z = depth.ptr<float>(y);
    auto* out = lit.ptr<std::uint8_t>(y);
    float frontier = 1e9F;
    for (int x = depth.cols - 1; x >= 0; --x) {
      if (!(z[x] > 0)) {
        out[x] = 0;
        continue;
      }
      const float in_projector = static_cast<float>(x) - shift / z[x];
      out[x] = in_projector < frontier + 1.5F ? 1 : 0;
      frontier = std::min(frontier, in_projector);
    }
  }
  return lit;
}

cv::Mat DepthSensor::image(const cv::Mat& depth, const cv::Mat& infrared, std::uint64_t seed) const {
  const cv::Mat lit = lit_by_projector(depth);
  const int width = depth.cols, height = depth.rows;
  const CellNoise shift_x(width, height, seed, 1), shift_y(width, height, seed, 2),
      disparity_noise(width, height, seed, 3);
  const CellNoise fading(width, height, seed, 4);
  constexpr float kDisparity = kBaseline * kFocal * kStepsPerPixel;  // disparity in steps = this / z
  const auto units = static_cast<float>(camera_.depth_units_per_metre);
  cv::Mat result = cv::Mat::zeros(depth.size(), CV_16UC1);
  for (int y = 0; y < height; ++y) {
    auto* out = result.ptr<std::uint16_t>(y);
    for (int x = 0; x < width; ++x) {
      const int sx = std::clamp(static_cast<int>(std::lround(x + kOutline * shift_x.at(x, y))), 0, width - 1);
      const int sy =
          std::clamp(static_cast<int>(std::lround(y + kOutline * shift_y.at(x, y))), 0, height - 1);
      const float z = depth.at<float>(sy, sx);
      if (lit.at<std::uint8_t>(sy, sx) == 0 || z < kMinDepth || z > kMaxDepth) continue;
      // The return falls with distance, dark material and grazing angle; holes come in patches.
      const float reach = 1 - std::max(0.0F, (z - kReliableDepth) / (kMaxDepth - kReliableDepth));
      const float seen = infrared.at<float>(sy, sx) * reach;
      if (seen < std::max(kMinInfrared, kMedianInfrared + 0.17F * fading.at(x, y))) continue;
      const float steps = std::round(kDisparity / z + kNoise * disparity_noise.at(x, y));
      if (steps <= 0) continue;
      out[x] = static_cast<std::uint16_t>(std::clamp(units * kDisparity / steps + 0.5F, 0.0F, 65535.0F));
    }
  }
  return result;
}

}  // namespace stdc::simulation
