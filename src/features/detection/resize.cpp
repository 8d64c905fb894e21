#include "features/detection/resize.hpp"

#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "features/detection/resize.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#ifndef STDC_FEATURES_RESIZE_ONCE
#define STDC_FEATURES_RESIZE_ONCE
namespace stdc {
namespace {

constexpr int kUnit = 128;  // weights are in 1/128

/// Source pixel and weight of its right (or lower) neighbour for a target pixel.
struct ShrinkSample {
  int index, weight;
};

/// The samples of eight neighbouring target pixels: 16 source bytes from `start` on, shuffles that make
/// 16-bit lanes of the left and the right neighbours, and their weights.
struct ShrinkStep {
  int start = 0;
  alignas(16) std::uint8_t left[16], right[16];
  alignas(16) std::uint16_t left_weight[8], right_weight[8];
};

ShrinkSample shrink_sample(int target, double factor, int source_size) {
  const double position = (target + 0.5) * factor - 0.5;
  const int index = static_cast<int>(position);
  // On the last pixel: all weight on the right neighbour, so that there is one.
  if (index >= source_size - 1) return {source_size - 2, kUnit};
  return {index, static_cast<int>((position - index) * kUnit + 0.5)};
}

std::vector<ShrinkStep> shrink_steps(int target_width, double factor, int source_width) {
  constexpr std::uint8_t kZero = 0x80;  // a shuffle index that gives a zero byte
  std::vector<ShrinkStep> steps(static_cast<std::size_t>((target_width + 7) / 8));
  for (int x = 0; x < static_cast<int>(steps.size()) * 8; ++x) {
    const ShrinkSample sample = shrink_sample(x < target_width ? x : target_width - 1, factor, source_width);
    ShrinkStep& step = steps[static_cast<std::size_t>(x / 8)];
    const int i = x % 8;
    if (i == 0) step.start = sample.index;
    const int offset = sample.index - step.start;  // <= 14 because the factor is at most 2
    step.left[2 * i] = static_cast<std::uint8_t>(offset);
    step.right[2 * i] = static_cast<std::uint8_t>(offset + 1);
    step.left[2 * i + 1] = step.right[2 * i + 1] = kZero;
    step.left_weight[i] = static_cast<std::uint16_t>(kUnit - sample.weight);
    step.right_weight[i] = static_cast<std::uint16_t>(sample.weight);
  }
  return steps;
}

}  // namespace
}  // namespace stdc
#endif

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// One row of the source at the columns of the target, in 1/128 grey level.
void shrink_row(const std::uint8_t* HWY_RESTRICT source, const std::vector<ShrinkStep>& steps,
                std::uint16_t* HWY_RESTRICT result) {
  for (const ShrinkStep& step : steps) {
    const std::uint8_t* from = source + step.start;
#if HWY_TARGET == HWY_SCALAR
    for (int i = 0; i < 8; ++i) {
      result[i] = static_cast<std::uint16_t>(from[step.left[2 * i]] * step.left_weight[i] +
                                             from[step.right[2 * i]] * step.right_weight[i]);
    }
#else
    const hn::FixedTag<std::uint8_t, 16> d8;
    const hn::FixedTag<std::uint16_t, 8> d16;
    const auto bytes = hn::LoadU(d8, from);
    const auto left = hn::BitCast(d16, hn::TableLookupBytesOr0(bytes, hn::Load(d8, step.left)));
    const auto right = hn::BitCast(d16, hn::TableLookupBytesOr0(bytes, hn::Load(d8, step.right)));
    const auto sum = hn::Add(hn::Mul(left, hn::Load(d16, step.left_weight)),
                             hn::Mul(right, hn::Load(d16, step.right_weight)));
    hn::StoreU(sum, d16, result);
#endif
    result += 8;
  }
}

// A target row from two such rows: the high halves of the products are in 1/64 grey level.
void blend_rows(const std::uint16_t* HWY_RESTRICT upper, const std::uint16_t* HWY_RESTRICT lower,
                int lower_weight, int width, std::uint8_t* HWY_RESTRICT target) {
  const hn::ScalableTag<std::uint16_t> d16;
  const hn::RebindToSigned<decltype(d16)> d16_signed;
  const hn::Rebind<std::uint8_t, decltype(d16)> d8;
  const auto weight_upper = hn::Set(d16, static_cast<std::uint16_t>((kUnit - lower_weight) * 256));
  const auto weight_lower = hn::Set(d16, static_cast<std::uint16_t>(lower_weight * 256));
  const auto half = hn::Set(d16, 32);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d16))) {
    const auto sum = hn::Add(hn::MulHigh(hn::LoadU(d16, upper + x), weight_upper),
                             hn::MulHigh(hn::LoadU(d16, lower + x), weight_lower));
    const auto grey = hn::BitCast(d16_signed, hn::ShiftRight<6>(hn::Add(sum, half)));
    hn::StoreU(hn::DemoteTo(d8, grey), d8, target + x);
  }
}

void shrink_image(const ImageView& source, double factor, PaddedImage& target) {
  const std::vector<ShrinkStep> steps = shrink_steps(target.width(), factor, source.width);
  const std::size_t row_size = steps.size() * 8 + PaddedImage::kPadding;
  std::vector<std::uint16_t> rows[2] = {std::vector<std::uint16_t>(row_size),
                                        std::vector<std::uint16_t>(row_size)};
  int next_row = 0;  // rows below this one are made; the last two of them are kept
  for (int y = 0; y < target.height(); ++y) {
    const ShrinkSample sample = shrink_sample(y, factor, source.height);
    for (next_row = next_row > sample.index ? next_row : sample.index; next_row <= sample.index + 1;
         ++next_row) {
      shrink_row(source.row(next_row), steps, rows[next_row % 2].data());
    }
    blend_rows(rows[sample.index % 2].data(), rows[(sample.index + 1) % 2].data(), sample.weight,
               target.width(), target.row(y));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(shrink_image);

void shrink(const ImageView& source, double factor, PaddedImage& target) {
  HWY_DYNAMIC_DISPATCH(shrink_image)(source, factor, target);
}

}  // namespace stdc
#endif
