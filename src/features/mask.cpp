#include "features/mask.hpp"

#include <algorithm>
#include <cmath>

namespace stdc {

void DynamicArea::set(const cv::Mat& mask) {
  width_ = mask.cols;
  height_ = mask.rows;
  const auto row_size = static_cast<std::size_t>(width_) + 1;
  sums_.assign(row_size * (static_cast<std::size_t>(height_) + 1), 0);
  for (int y = 0; y < height_; ++y) {
    const std::uint8_t* row = mask.ptr(y);
    const std::uint32_t* above = sums_.data() + static_cast<std::size_t>(y) * row_size + 1;
    std::uint32_t* sums = sums_.data() + (static_cast<std::size_t>(y) + 1) * row_size + 1;
    std::uint32_t along = 0;
    for (int x = 0; x < width_; ++x) {
      along += row[x] != 0 ? 1 : 0;
      sums[x] = above[x] + along;
    }
  }
  empty_ = sums_.back() == 0;
}

bool DynamicArea::touches(float x, float y, float radius) const {
  if (empty_) return false;
  const auto clamp = [](float value, int size) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(value), 0, size));
  };
  const std::size_t left = clamp(std::ceil(x - radius), width_), top = clamp(std::ceil(y - radius), height_);
  const std::size_t right = clamp(std::floor(x + radius) + 1, width_);
  const std::size_t bottom = clamp(std::floor(y + radius) + 1, height_);
  const auto row_size = static_cast<std::size_t>(width_) + 1;
  const std::uint32_t* upper = sums_.data() + top * row_size;
  const std::uint32_t* lower = sums_.data() + bottom * row_size;
  return lower[right] - lower[left] != upper[right] - upper[left];
}

}  // namespace stdc
