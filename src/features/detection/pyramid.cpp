#include "features/detection/pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "features/detection/resize.hpp"

namespace stdc {

int level_count(const FeatureSettings& settings, cv::Size image_size) {
  constexpr int kClassicLevels = 8;
  if (settings.levels > 0) return settings.levels;
  if (settings.selection == Selection::orb_slam3) return kClassicLevels;
  return std::max(1, static_cast<int>(std::lround(std::max(image_size.width, image_size.height) / 100.0)));
}

std::vector<cv::Size> level_sizes(const FeatureSettings& settings, cv::Size image_size) {
  std::vector<cv::Size> sizes{image_size};
  // Pixel x of a level lies at (x + 0.5) * factor - 0.5 <= size - 1 of the level below.
  const auto smaller = [&](int size) {
    return std::max(1, static_cast<int>(std::floor((size - 0.5) / settings.scale_factor + 0.5)));
  };
  while (static_cast<int>(sizes.size()) < level_count(settings, image_size)) {
    sizes.emplace_back(smaller(sizes.back().width), smaller(sizes.back().height));
  }
  return sizes;
}

std::vector<int> level_budgets(const FeatureSettings& settings, const std::vector<cv::Size>& sizes) {
  const double step = settings.selection == Selection::improved
                          ? 1 / (settings.scale_factor * settings.scale_factor)
                          : 1 / settings.scale_factor;
  std::vector<double> weights;
  double weight = 1;
  for (const cv::Size& size : sizes) {
    weights.push_back(std::min(size.width, size.height) > 2 * kBorder ? weight : 0);
    weight *= step;
  }
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  // Rounding the running sum leaves no remainder: the budgets add up to N, each within 1 of Eq. 5.
  std::vector<int> budgets;
  double running = 0;
  int given = 0;
  for (const double w : weights) {
    running += w;
    const int until_here =
        total > 0 ? static_cast<int>(std::lround(settings.keypoints * running / total)) : 0;
    budgets.push_back(until_here - given);
    given = until_here;
  }
  return budgets;
}

void Pyramid::build(const cv::Mat& grey, const FeatureSettings& settings) {
  sizes_ = level_sizes(settings, grey.size());
  images_.resize(sizes_.size());
  const std::ptrdiff_t stride = PaddedImage::stride_for(grey.cols);
  images_[0].resize(grey.cols, grey.rows, stride);
  for (int y = 0; y < grey.rows; ++y) {
    std::memcpy(images_[0].row(y), grey.ptr(y), static_cast<std::size_t>(grey.cols));
  }
  for (std::size_t i = 1; i < sizes_.size(); ++i) {
    images_[i].resize(sizes_[i].width, sizes_[i].height, stride);
    shrink(images_[i - 1].view(), settings.scale_factor, images_[i]);
  }
}

}  // namespace stdc
