#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace stdc {

/// Whether a mask (CV_8UC1) is not zero at the pixel nearest to a point; outside: at the edge.
bool is_set_at(const cv::Mat& mask, float x, float y);

/// Tells whether a dynamic pixel is near a point; fast for many points and few radii.
class DynamicArea {
 public:
  /// `mask`: CV_8UC1, not zero = dynamic; empty: nothing is dynamic.
  void set(const cv::Mat& mask);
  bool empty() const { return empty_; }
  /// Sets the radius of near() [px], at least 0. Cheapest with ascending radii.
  void spread(int radius);
  /// Is any pixel with |dx| <= radius and |dy| <= radius of (x, y) dynamic? Places outside the image are not
  /// near anything.
  bool near(int x, int y) const {
    if (empty_ || x < 0 || y < 0 || x >= width_ || y >= height_) return false;
    const std::size_t word = static_cast<std::size_t>(y) * words_ + static_cast<std::size_t>(x) / 64;
    return (spread_[word] >> (static_cast<unsigned>(x) % 64U) & 1U) != 0;
  }

 private:
  int width_ = 0, height_ = 0;
  int radius_ = 0;  // by which `spread_` is spread
  bool empty_ = true;
  std::size_t words_ = 0;  // of 64 pixels, in a row
  // A bit for each pixel, row by row: the mask, and the mask spread.
  std::vector<std::uint64_t> rows_, spread_, scratch_;
};

}  // namespace stdc
