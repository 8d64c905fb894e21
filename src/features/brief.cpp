#include "features/brief.hpp"

#include <cmath>
#include <numbers>

namespace stdc {
namespace {

std::int8_t nearest(double value) {
  // The bias decides ties the same way whatever the last bit of sin and cos is.
  return static_cast<std::int8_t>(std::floor(value + 0.5 + 1e-9));
}

BriefPattern turn(const BriefPattern& pattern, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  BriefPattern turned;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const BriefTest& test = pattern[i];
    turned[i] = {nearest(c * test.x0 - s * test.y0), nearest(s * test.x0 + c * test.y0),
                 nearest(c * test.x1 - s * test.y1), nearest(s * test.x1 + c * test.y1)};
  }
  return turned;
}

}  // namespace

BriefExtractor::BriefExtractor(const BriefPattern& pattern) {
  for (int i = 0; i < kAngles; ++i) turned_.push_back(turn(pattern, 2 * std::numbers::pi * i / kAngles));
}

void BriefExtractor::set_stride(std::ptrdiff_t stride) {
  stride_ = stride;
  offsets_.clear();
  offsets_.reserve(turned_.size() * turned_[0].size() * 2);
  for (const BriefPattern& pattern : turned_) {
    for (const BriefTest& test : pattern) {
      offsets_.push_back(static_cast<std::int32_t>(test.y0 * stride + test.x0));
      offsets_.push_back(static_cast<std::int32_t>(test.y1 * stride + test.x1));
    }
  }
}

Descriptor BriefExtractor::describe(const ImageView& smoothed, int x, int y, float angle) {
  if (smoothed.stride != stride_) set_stride(smoothed.stride);
  const double turns = angle / (2 * std::numbers::pi);
  const int bin = static_cast<int>(std::lround(turns * kAngles)) & (kAngles - 1);
  const std::int32_t* offset = offsets_.data() + static_cast<std::size_t>(bin) * 512;
  const std::uint8_t* centre = smoothed.row(y) + x;
  Descriptor descriptor;
  for (std::uint64_t& word : descriptor.bits) {
    std::uint64_t bits = 0;
    for (int i = 0; i < 64; ++i, offset += 2) {
      bits = bits << 1U | static_cast<std::uint64_t>(centre[offset[0]] < centre[offset[1]]);
    }
    word = bits;
  }
  return descriptor;
}

}  // namespace stdc
