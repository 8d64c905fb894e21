#include "features/description/patch_alignment.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

namespace stdc {
namespace {

/// A smooth picture of corners that can be evaluated anywhere: rotated, scaled and shifted.
struct Picture {
  static constexpr int kSize = 96;
  std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(kSize * kSize);

  /// Shows at pixel p what lies at `a * (p - centre) + origin`, with another gain and offset of brightness.
  Picture(const Eigen::Matrix2f& a, const Eigen::Vector2f& centre, const Eigen::Vector2f& origin,
          float gain = 1, float offset = 0) {
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const Eigen::Vector2f p =
            a * (Eigen::Vector2f(static_cast<float>(x), static_cast<float>(y)) - centre) + origin;
        const float value =
            110 + 40 * std::sin(0.7F * p.x() + 0.2F * p.y()) + 30 * std::cos(0.6F * p.y() - 0.1F * p.x());
        pixels[y * kSize + x] = static_cast<std::uint8_t>(std::lround(gain * value + offset));
      }
    }
  }
  ImageView view() const { return {pixels.data(), kSize, kSize, kSize}; }
};

const Eigen::Vector2f kMiddle(48, 48);

TEST(PatchAlignment, FindsAShiftToATenthOfAPixel) {
  const Picture reference(Eigen::Matrix2f::Identity(), kMiddle, {0, 0});
  const Patch patch = cut_patch(reference.view(), 48, 48);
  PatchTemplate pattern;
  ASSERT_TRUE(pattern.make(patch, Eigen::Matrix2f::Identity()));
  for (const Eigen::Vector2f& shift : {Eigen::Vector2f(0.3F, -0.6F), Eigen::Vector2f(-1.2F, 0.8F)}) {
    const Picture moved(Eigen::Matrix2f::Identity(), kMiddle + shift, {0, 0}, 0.8F, 20);
    Eigen::Vector2f position = kMiddle;
    ASSERT_TRUE(pattern.align(moved.view(), 3, position));
    EXPECT_LT((position - kMiddle - shift).norm(), 0.1F);
  }
}

TEST(PatchAlignment, FollowsAKnownTurnAndScale) {
  const float angle = 0.6F, scale = 1.1F;
  Eigen::Matrix2f view_from_patch;
  view_from_patch << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  view_from_patch *= scale;
  const Picture reference(Eigen::Matrix2f::Identity(), kMiddle, {0, 0});
  const Eigen::Vector2f shift(0.7F, 0.4F);
  const Picture rotated(view_from_patch.inverse(), kMiddle + shift, {0, 0});
  PatchTemplate pattern;
  ASSERT_TRUE(pattern.make(cut_patch(reference.view(), 48, 48), view_from_patch));
  Eigen::Vector2f position = kMiddle;
  ASSERT_TRUE(pattern.align(rotated.view(), 3, position));
  EXPECT_LT((position - kMiddle - shift).norm(), 0.1F);
}

TEST(PatchAlignment, RefusesWhatCannotBeAligned) {
  Patch flat;
  flat.pixels.fill(100);
  PatchTemplate pattern;
  EXPECT_FALSE(pattern.make(flat, Eigen::Matrix2f::Identity()));
  Patch edge;  // tells nothing about a shift along it
  for (int i = 0; i < Patch::kSide * Patch::kSide; ++i) edge.pixels[i] = i % Patch::kSide < 8 ? 20 : 200;
  EXPECT_FALSE(pattern.make(edge, Eigen::Matrix2f::Identity()));
  const Picture reference(Eigen::Matrix2f::Identity(), kMiddle, {0, 0});
  const Patch patch = cut_patch(reference.view(), 48, 48);
  EXPECT_FALSE(pattern.make(patch, 0.3F * Eigen::Matrix2f::Identity())) << "reaches out of the patch";
  EXPECT_FALSE(pattern.make(patch, Eigen::Matrix2f::Zero()));
  EXPECT_FALSE(pattern.make(patch, Eigen::Matrix2f::Constant(NAN)));
}

TEST(PatchAlignment, RefusesWhatLooksDifferentOrLiesOutside) {
  const Picture reference(Eigen::Matrix2f::Identity(), kMiddle, {0, 0});
  PatchTemplate pattern;
  ASSERT_TRUE(pattern.make(cut_patch(reference.view(), 48, 48), Eigen::Matrix2f::Identity()));
  const std::vector<std::uint8_t> black(96 * 96, 0);
  Eigen::Vector2f position = kMiddle;
  EXPECT_FALSE(pattern.align({black.data(), 96, 96, 96}, 3, position));
  EXPECT_EQ(position, kMiddle);
  for (const Eigen::Vector2f& outside :
       {Eigen::Vector2f(1, 48), Eigen::Vector2f(48, 94), Eigen::Vector2f(-9, NAN)}) {
    position = outside;
    EXPECT_FALSE(pattern.align(reference.view(), 3, position));
  }
}

}  // namespace
}  // namespace stdc
