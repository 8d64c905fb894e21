#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace stdc::simulation {

/// Model of a colour camera: linear light to 8 bits by exposure, vignetting, shot and read noise (Healey and
/// Kondepudy 1994), the sRGB curve and clipping.
class ColourSensor {
 public:
  ColourSensor();

  /// @param linear    CV_32FC3, linear red green blue
  /// @param exposure  gain on the light
  /// @param seed      of the noise; use another for each frame
  /// @return CV_8UC3, blue green red
  cv::Mat image(const cv::Mat& linear, float exposure, std::uint64_t seed) const;

 private:
  std::vector<float> code_;    ///< 8-bit code of linear light, by table
  std::vector<float> sigma_;   ///< standard deviation of the code
  std::vector<float> normal_;  ///< a table of standard normal values in random order
};

}  // namespace stdc::simulation
