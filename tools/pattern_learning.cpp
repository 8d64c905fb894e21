#include "pattern_learning.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

#include "core/error.hpp"
#include "core/random.hpp"
#include "features/detection/blur.hpp"
#include "features/detection/pyramid.hpp"
#include "features/extractor.hpp"

namespace stdc {
namespace {

constexpr int kSide = 2 * kBriefRadius + 1;
constexpr std::size_t kBatch = 64;  // keypoints

bool in_disc(int x, int y) { return x * x + y * y <= kBriefRadius * kBriefRadius; }
std::size_t cell(int x, int y) {
  const int index = (y + kBriefRadius) * kSide + x + kBriefRadius;
  return static_cast<std::size_t>(index);
}

std::vector<BriefTest> draw_tests(int count, double nearest, std::uint64_t seed) {
  Random random(seed);
  const auto draw = [&](std::int8_t& x, std::int8_t& y) {
    do {
      x = static_cast<std::int8_t>(static_cast<int>(random.below(kSide)) - kBriefRadius);
      y = static_cast<std::int8_t>(static_cast<int>(random.below(kSide)) - kBriefRadius);
    } while (!in_disc(x, y));
  };
  std::set<std::tuple<int, int, int, int>> drawn;
  std::vector<BriefTest> tests;
  while (static_cast<int>(tests.size()) < count) {
    BriefTest test{};
    draw(test.x0, test.y0);
    draw(test.x1, test.y1);
    if (std::hypot(test.x0 - test.x1, test.y0 - test.y1) < nearest) continue;
    if (drawn.emplace(test.x0, test.y0, test.x1, test.y1).second) tests.push_back(test);
  }
  return tests;
}

/// The rotated, smoothed patches of 64 keypoints: [pixel][keypoint].
using PatchBatch = std::vector<std::array<std::uint8_t, kBatch>>;

std::vector<PatchBatch> cut_patches(std::span<const cv::Mat> images) {
  const FeatureSettings settings;
  FeatureExtractor extractor(settings);
  Pyramid pyramid;
  std::vector<PatchBatch> batches;
  std::size_t patches = 0;
  for (const cv::Mat& image : images) {
    const Features features = extractor.extract(image);
    pyramid.build(image, settings);
    std::vector<PaddedImage> smoothed(static_cast<std::size_t>(pyramid.levels()));
    for (int i = 0; i < pyramid.levels(); ++i) {
      gaussian_blur(pyramid.level(i).view(), smoothed[static_cast<std::size_t>(i)]);
    }
    for (const Keypoint& keypoint : features.keypoints) {
      if (patches % kBatch == 0) batches.emplace_back(static_cast<std::size_t>(kSide) * kSide);
      const float scale = extractor.scale(keypoint.level);
      const auto to_level = [&](float v) { return static_cast<int>(std::lround((v + 0.5F) / scale - 0.5F)); };
      const int x = to_level(keypoint.x), y = to_level(keypoint.y);
      const double c = std::cos(keypoint.angle), s = std::sin(keypoint.angle);
      for (int v = -kBriefRadius; v <= kBriefRadius; ++v) {
        for (int u = -kBriefRadius; u <= kBriefRadius; ++u) {
          if (!in_disc(u, v)) continue;
          const int column = x + static_cast<int>(std::lround(c * u - s * v));
          const int row = y + static_cast<int>(std::lround(s * u + c * v));
          batches.back()[cell(u, v)][patches % kBatch] = smoothed[keypoint.level].view().at(column, row);
        }
      }
      ++patches;
    }
  }
  if (patches % kBatch != 0) batches.pop_back();  // whole words only
  return batches;
}

double mean_of(const TestResults& results, std::size_t test) {
  const auto first = results.bits.begin() + static_cast<std::ptrdiff_t>(test * results.words);
  const int ones = std::accumulate(first, first + static_cast<std::ptrdiff_t>(results.words), 0,
                                   [](int sum, std::uint64_t word) { return sum + std::popcount(word); });
  return ones / results.keypoints();
}

double correlation(const TestResults& results, const std::vector<double>& means, std::size_t a,
                   std::size_t b) {
  int both = 0;
  for (std::size_t w = 0; w < results.words; ++w) {
    both += std::popcount(results.bits[a * results.words + w] & results.bits[b * results.words + w]);
  }
  const double covariance = both / results.keypoints() - means[a] * means[b];
  return std::abs(covariance) / std::sqrt(means[a] * (1 - means[a]) * means[b] * (1 - means[b]));
}

/// The first 256 tests in the order that are pairwise less correlated than the threshold; fewer if there are
/// not.
std::vector<std::size_t> take_uncorrelated(const TestResults& results, const std::vector<double>& means,
                                           const std::vector<std::size_t>& order, double threshold) {
  std::vector<std::size_t> taken;
  for (const std::size_t test : order) {
    if (taken.size() == BriefPattern().size()) break;
    if (std::all_of(taken.begin(), taken.end(), [&](std::size_t other) {
          return correlation(results, means, test, other) < threshold;
        })) {
      taken.push_back(test);
    }
  }
  return taken;
}

}  // namespace

TestResults evaluate_random_tests(std::span<const cv::Mat> images, int count, double nearest,
                                  std::uint64_t seed) {
  const std::vector<PatchBatch> batches = cut_patches(images);
  TestResults results;
  results.tests = draw_tests(count, nearest, seed);
  results.words = batches.size();
  for (const BriefTest& test : results.tests) {
    for (const PatchBatch& batch : batches) {
      const auto& a = batch[cell(test.x0, test.y0)];
      const auto& b = batch[cell(test.x1, test.y1)];
      std::uint64_t word = 0;
      for (std::size_t k = 0; k < kBatch; ++k) word |= static_cast<std::uint64_t>(a[k] < b[k]) << k;
      results.bits.push_back(word);
    }
  }
  return results;
}

BriefPattern learn_pattern(const TestResults& results) {
  std::vector<double> means;
  std::vector<std::size_t> order;
  for (std::size_t t = 0; t < results.tests.size(); ++t) {
    means.push_back(mean_of(results, t));
    if (means[t] > 0 && means[t] < 1) order.push_back(t);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(means[a] - 0.5) < std::abs(means[b] - 0.5);
  });
  std::vector<std::size_t> best;
  int too_low = 0, enough = 100;  // hundredths
  while (enough - too_low > 1) {
    const int middle = (too_low + enough) / 2;
    const std::vector<std::size_t> taken = take_uncorrelated(results, means, order, middle / 100.0);
    const bool is_enough = taken.size() == BriefPattern().size();
    (is_enough ? enough : too_low) = middle;
    if (is_enough) best = taken;
  }
  if (best.empty()) {
    throw Error("learn_pattern", "there are not 256 different tests", "draw more tests or give more images");
  }
  BriefPattern pattern{};
  for (std::size_t i = 0; i < pattern.size(); ++i) pattern[i] = results.tests[best[i]];
  return pattern;
}

}  // namespace stdc
