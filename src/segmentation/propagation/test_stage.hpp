#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

// Frames for tests: a textured body anywhere before a textured wall.

namespace stdc::test {

inline constexpr double kUnits = 5000, kBodyDepth = 1.6, kWallDepth = 3;

/// Blobs of many sizes with the grey levels of a real picture.
cv::Mat texture(cv::Size size, std::uint64_t seed);

/// A picture, its depths (kUnits to the metre) and where the body is (255).
struct Shot {
  cv::Mat grey, depth, mask;
};

/// A body of the given outline before a wall, both textured.
class Stage {
 public:
  explicit Stage(cv::Size size = {640, 480})
      : size_(size), wall_(texture(size, 1)), cloth_(texture({400, 500}, 2)) {}

  Shot shoot(cv::Point body, cv::Size body_size = {150, 260}, double body_depth = kBodyDepth) const;

 private:
  cv::Size size_;
  cv::Mat wall_, cloth_;
};

}  // namespace stdc::test
