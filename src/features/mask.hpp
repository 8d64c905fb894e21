#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace stdc {

/// Answers whether there is a dynamic pixel near a place, for any radius at the same cost (integral image).
class DynamicArea {
 public:
  /// `mask`: CV_8UC1, not zero = dynamic; empty: nothing is dynamic.
  void set(const cv::Mat& mask);
  bool empty() const { return empty_; }
  /// Is any pixel with |dx| <= radius and |dy| <= radius of (x, y) [px] dynamic?
  bool touches(float x, float y, float radius) const;

 private:
  int width_ = 0, height_ = 0;
  bool empty_ = true;
  std::vector<std::uint32_t> sums_;  // (width + 1) x (height + 1): dynamic pixels above and to the left
};

}  // namespace stdc
