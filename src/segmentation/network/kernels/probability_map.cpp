#include "segmentation/network/kernels/probability_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace stdc {
namespace {

/// log(sum of exp) over the classes that are dynamic or that are not.
float log_sum(const Logits& logits, std::size_t pixel, const std::vector<bool>& dynamic, bool wanted) {
  const auto plane = static_cast<std::size_t>(logits.height) * static_cast<std::size_t>(logits.width);
  float max = -std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < dynamic.size(); ++k)
    if (dynamic[k] == wanted) max = std::max(max, logits.planes[k * plane + pixel]);
  float sum = 0;
  for (std::size_t k = 0; k < dynamic.size(); ++k)
    if (dynamic[k] == wanted) sum += std::exp(logits.planes[k * plane + pixel] - max);
  return max + std::log(sum);
}

}  // namespace

cv::Mat draw_probabilities(const Logits& logits, cv::Size size, const std::vector<bool>& dynamic,
                           const ProbabilityCalibration& calibration) {
  cv::Mat odds(logits.height, logits.width, CV_32FC1), probability;
  for (std::size_t i = 0; i < odds.total(); ++i)
    odds.ptr<float>()[i] = log_sum(logits, i, dynamic, true) - log_sum(logits, i, dynamic, false);
  cv::resize(odds, probability, size, 0, 0, cv::INTER_LINEAR);
  for (int y = 0; y < size.height; ++y) {
    float* const row = probability.ptr<float>(y);
    for (int x = 0; x < size.width; ++x)
      row[x] = 1 / (1 + std::exp(-(calibration.scale * row[x] + calibration.offset)));
  }
  return probability;
}

}  // namespace stdc
