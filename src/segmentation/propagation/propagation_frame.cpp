#include "segmentation/propagation/propagation_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace stdc {
namespace {

void add_row(const std::uint8_t* __restrict row, int count, std::uint16_t* __restrict sums) {
  for (int x = 0; x < count; ++x) sums[x] = static_cast<std::uint16_t>(sums[x] + row[x]);
}

/// Means of squares of `scale` x `scale` pixels.
void shrink_grey(const cv::Mat& grey, int scale, SmallImage& small) {
  small.resize(grey.cols / scale, grey.rows / scale);
  const int used = small.width() * scale, area = scale * scale;
  std::vector<std::uint16_t> sums(static_cast<std::size_t>(used));
  for (int y = 0; y < small.height(); ++y) {
    std::fill(sums.begin(), sums.end(), 0);
    for (int i = 0; i < scale; ++i) add_row(grey.ptr(y * scale + i), used, sums.data());
    std::uint8_t* to = small.row(y);
    for (int x = 0; x < small.width(); ++x) {
      int sum = area / 2;
      for (int i = 0; i < scale; ++i) sum += sums[static_cast<std::size_t>(x * scale + i)];
      to[x] = static_cast<std::uint8_t>(sum / area);
    }
  }
  small.fill_border();
}

void halve(const SmallImage& image, SmallImage& half) {
  half.resize(image.width() / 2, image.height() / 2);
  for (int y = 0; y < half.height(); ++y) {
    const std::uint8_t *upper = image.row(2 * y), *lower = image.row(2 * y + 1);
    std::uint8_t* to = half.row(y);
    for (int x = 0; x < half.width(); ++x) {
      to[x] = static_cast<std::uint8_t>(
          (upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1] + 2) / 4);
    }
  }
  half.fill_border();
}

/// The first depth there is of up to four pixels in the middle of each cell: a mean would make up surfaces
/// between the near and the far one.
void sample_depth(const cv::Mat& depth, float metres_per_unit, SmallFrame& small) {
  const int low = (small.scale - 1) / 2, high = small.scale / 2;
  small.depth.resize(static_cast<std::size_t>(small.width() * small.height()));
  for (int y = 0; y < small.height(); ++y) {
    for (int x = 0; x < small.width(); ++x) {
      const int left = x * small.scale, top = y * small.scale;
      float metres = metres_at(depth, left + low, top + low, metres_per_unit);
      if (metres == 0) metres = metres_at(depth, left + high, top + high, metres_per_unit);
      if (metres == 0) metres = metres_at(depth, left + high, top + low, metres_per_unit);
      if (metres == 0) metres = metres_at(depth, left + low, top + high, metres_per_unit);
      small.depth[static_cast<std::size_t>(y * small.width() + x)] = metres;
    }
  }
}

}  // namespace

void SmallImage::resize(int width, int height) {
  width_ = width;
  height_ = height;
  pixels_.resize(static_cast<std::size_t>(stride() * (height + 2 * kBorder)));
}

void SmallImage::fill_border() {
  for (int y = 0; y < height_; ++y) {
    std::memset(row(y) - kBorder, row(y)[0], kBorder);
    std::memset(row(y) + width_, row(y)[width_ - 1], kBorder);
  }
  for (int i = 1; i <= kBorder; ++i) {
    std::memcpy(row(-i) - kBorder, row(0) - kBorder, static_cast<std::size_t>(stride()));
    std::memcpy(row(height_ - 1 + i) - kBorder, row(height_ - 1) - kBorder,
                static_cast<std::size_t>(stride()));
  }
}

int cell_size(int frame_width) {
  constexpr int kWidth = 160;
  return std::max(1, (frame_width + kWidth / 2) / kWidth);
}

float metres_at(const cv::Mat& depth, int x, int y, float metres_per_unit) {
  if (depth.type() == CV_16UC1) return static_cast<float>(depth.at<std::uint16_t>(y, x)) * metres_per_unit;
  const float metres = depth.at<float>(y, x);
  return metres > 0 && std::isfinite(metres) ? metres : 0;
}

void shrink_depth(const cv::Mat& depth, double units_per_metre, SmallFrame& small) {
  small.scale = cell_size(depth.cols);
  small.levels[0].resize(depth.cols / small.scale, depth.rows / small.scale);
  sample_depth(depth, static_cast<float>(1 / units_per_metre), small);
}

void shrink_frame(const cv::Mat& grey, const cv::Mat& depth, double units_per_metre, SmallFrame& small) {
  shrink_depth(depth, units_per_metre, small);
  shrink_grey(grey, small.scale, small.levels[0]);
  for (int i = 1; i < SmallFrame::kLevels; ++i) {
    halve(small.levels[static_cast<std::size_t>(i - 1)], small.levels[static_cast<std::size_t>(i)]);
  }
}

}  // namespace stdc
