#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "features/description/brief.hpp"

namespace stdc {

/// Results of candidate tests on many keypoints, one bit each.
struct TestResults {
  std::vector<BriefTest> tests;
  std::vector<std::uint64_t> bits;  ///< [test][word], 64 keypoints a word
  std::size_t words = 0;            ///< per test

  double keypoints() const { return static_cast<double>(words) * 64; }
};

/// Draws `count` different pairs of pixels of the disc, at least `nearest` px apart, and evaluates them in
/// the frame of the keypoints of the images (CV_8UC1), smoothed as for descriptors.
TestResults evaluate_random_tests(std::span<const cv::Mat> images, int count, double nearest,
                                  std::uint64_t seed);

/// The greedy search of rBRIEF (Rublee et al., ORB, ICCV 2011, sec. 4.3): tests ordered by the distance of
/// their mean from 1/2; from the first on, a test is taken if its absolute correlation with every one taken
/// before is below a threshold; the smallest threshold (in steps of 0.01) that gives 256 tests is used.
BriefPattern learn_pattern(const TestResults& results);

}  // namespace stdc
