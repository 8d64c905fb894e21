#include "features/description/brief.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/every_target.hpp"
#include "core/random.hpp"
#include "features/description/hamming.hpp"
#include "features/test_images.hpp"

namespace stdc {
namespace {

Direction direction(double angle) {
  return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

TEST(Brief, PatternLiesInTheDiscAndComparesDifferentPixels) {
  for (const BriefTest& test : brief_pattern()) {
    EXPECT_LE(test.x0 * test.x0 + test.y0 * test.y0, kBriefRadius * kBriefRadius);
    EXPECT_LE(test.x1 * test.x1 + test.y1 * test.y1, kBriefRadius * kBriefRadius);
    EXPECT_TRUE(test.x0 != test.x1 || test.y0 != test.y1);
  }
}

TEST(Brief, UnturnedBitsAreTheTests) {
  const PaddedImage image = test::padded(test::noise_image(90, 80, 17));
  const BriefPattern& pattern = brief_pattern();
  const SteeredBrief brief(pattern);
  test::on_every_target([&] {
    const Descriptor descriptor = brief.describe(image.view(), 40, 30, {1, 0});
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      const BriefTest& t = pattern[i];
      const bool expected = image.view().at(40 + t.x0, 30 + t.y0) < image.view().at(40 + t.x1, 30 + t.y1);
      ASSERT_EQ((descriptor.bits[i / 64] >> (i % 64)) & 1U, expected ? 1U : 0U) << i;
    }
  });
}

TEST(Brief, TurnedPixelsAreTheNearestOnes) {
  // One test at a time on an image with a single bright pixel: the bit tells whether it was compared.
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const BriefTest test = brief_pattern()[random.below(256)];
    const double angle = random.uniform(-3.14, 3.14);
    const double u = std::cos(angle) * test.x1 - std::sin(angle) * test.y1;
    const double v = std::sin(angle) * test.x1 + std::cos(angle) * test.y1;
    const auto is_tie = [](double w) { return std::abs(w - std::floor(w) - 0.5) < 0.01; };
    if (is_tie(u) || is_tie(v)) continue;
    cv::Mat grey(64, 64, CV_8UC1, cv::Scalar(10));
    grey.at<std::uint8_t>(32 + static_cast<int>(std::lround(v)), 32 + static_cast<int>(std::lround(u))) = 200;
    BriefPattern pattern{};
    pattern.fill(test);
    const Descriptor descriptor =
        SteeredBrief(pattern).describe(test::padded(grey).view(), 32, 32, direction(angle));
    const double u0 = std::cos(angle) * test.x0 - std::sin(angle) * test.y0;
    const double v0 = std::sin(angle) * test.x0 + std::cos(angle) * test.y0;
    if (std::hypot(u0 - u, v0 - v) < 2) continue;
    EXPECT_EQ(descriptor.bits[1], ~std::uint64_t{0}) << angle;
  }
}

TEST(Brief, IsTheSameOnEveryTarget) {
  const PaddedImage image = test::padded(test::noise_image(90, 80, 18));
  const SteeredBrief brief;
  std::vector<Descriptor> first;
  test::on_every_target([&] {
    std::vector<Descriptor> descriptors;
    for (double angle = -3.1; angle < 3.2; angle += 0.01) {
      descriptors.push_back(brief.describe(image.view(), 45, 40, direction(angle)));
    }
    if (first.empty()) first = descriptors;
    EXPECT_EQ(descriptors, first);
  });
}

TEST(Brief, FlatImagesHaveNoBits) {
  const PaddedImage image = test::padded(cv::Mat(64, 64, CV_8UC1, cv::Scalar(99)));
  EXPECT_EQ(SteeredBrief().describe(image.view(), 30, 30, direction(1)), Descriptor());
}

TEST(Hamming, CountsDifferingBits) {
  Descriptor a, b;
  EXPECT_EQ(hamming_distance(a, b), 0);
  b.bits = {1, 3, 0, ~std::uint64_t{0}};
  EXPECT_EQ(hamming_distance(a, b), 67);
  EXPECT_EQ(hamming_distance(b, a), 67);
  a.bits = {~b.bits[0], ~b.bits[1], ~b.bits[2], ~b.bits[3]};
  EXPECT_EQ(hamming_distance(a, b), 256);
}

}  // namespace
}  // namespace stdc
