#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace stdc::test {

// What scripts/test_recordings/pattern_sequence.py draws.

constexpr int kPatternWidth = 64, kPatternHeight = 64, kPatternFrames = 4;
constexpr std::int64_t kPatternStart = 1'700'000'000'000'000'000;  // [ns]

/// Time of a frame's colour image [ns]; its depth image is 3 ms later.
inline std::int64_t pattern_time(int frame) { return kPatternStart + frame * 1'000'000LL / 30 * 1000; }

inline cv::Mat pattern_colour(int frame) {
  cv::Mat image(kPatternHeight, kPatternWidth, CV_8UC3);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const int red = 16 * (x / 8) + frame, green = 20 * (y / 8) + 2 * frame;
      const int blue = 40 * ((x / 8 + y / 8) % 2) + frame;
      image.at<cv::Vec3b>(y, x) = {static_cast<std::uint8_t>(blue), static_cast<std::uint8_t>(green),
                                   static_cast<std::uint8_t>(red)};
    }
  }
  return image;
}

/// [mm]
inline cv::Mat pattern_depth(int frame) {
  cv::Mat image(kPatternHeight, kPatternWidth, CV_16UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const int depth = x < 4 && y < 4 ? 0 : 1000 + 10 * (x / 8) + y / 8 + 100 * frame;
      image.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(depth);
    }
  }
  return image;
}

/// A recording of the pattern by somebody else's writer.
inline std::filesystem::path pattern_recording(const std::string& name) {
  return std::filesystem::path(STDC_TEST_RECORDINGS) / name;
}

inline bool same_pixels(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace stdc::test
