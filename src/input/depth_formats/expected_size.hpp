#pragma once

#include <fmt/format.h>

#include <opencv2/core/types.hpp>
#include <string>

namespace stdc {

/// Why an image of `width` x `height` will not do; empty if it will.
inline std::string size_problem(std::int64_t width, std::int64_t height, cv::Size expected) {
  constexpr std::int64_t kMaxSide = 16384;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    return fmt::format("says that it is {} x {} pixels", width, height);
  }
  if (expected.empty() || (width == expected.width && height == expected.height)) return "";
  return fmt::format("is {} x {} pixels, but the camera has {} x {}", width, height, expected.width,
                     expected.height);
}

}  // namespace stdc
