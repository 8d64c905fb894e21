#include "segmentation/network/kernels/dot_kernel.hpp"

#if defined(__aarch64__) && defined(__linux__)
#include <arm_neon.h>
#include <sys/auxv.h>

#include <algorithm>

// The instructions are allowed function by function: nothing else of the program is compiled for them.
#define STDC_DOT_PRODUCT __attribute__((target("arch=armv8.2-a+dotprod")))
#endif

namespace stdc {

#if defined(__aarch64__) && defined(__linux__)

namespace {

constexpr int kDotVectors = kDirectStrip / 4;

/// Bias, scale, rectifier and rounding for a strip at one pixel, as in the direct kernel.
STDC_DOT_PRODUCT void store_dots(const DirectJob& job, const int32x4_t* sums, int y, int x, int first) {
  float values[kDirectStrip];
  for (int i = 0; i < kDotVectors; ++i) {
    const int o = first + 4 * i;
    const float32x4_t sum = vaddq_f32(vcvtq_f32_s32(sums[i]), vld1q_f32(job.bias + o));
    float32x4_t value = vmulq_f32(sum, vld1q_f32(job.scale + o));
    if (job.relu) value = vmaxq_f32(value, vdupq_n_f32(0));
    vst1q_f32(values + 4 * i, value);
  }
  const TensorView& target = job.target;
  const int count = std::min(kDirectStrip, target.shape.channels - first);
  for (int i = 0; i < count; ++i) {
    const int o = first + i;
    const std::size_t place =
        target.offset(o / target.block, y, x) + static_cast<std::size_t>(o % target.block);
    if (target.type == ElementType::f32) {
      target.floats()[place] = values[i];
    } else {
      target.bytes()[place] =
          static_cast<std::uint8_t>(vcvtns_s32_f32(std::min(std::max(values[i], 0.0F), 255.0F)));
    }
  }
}

/// Adds one register of each pixel's channels to the sums.
template <int kPixels>
STDC_DOT_PRODUCT inline __attribute__((always_inline)) void add_channels(const std::uint8_t* const* pixels,
                                                                         int channel,
                                                                         const std::int8_t* weights,
                                                                         int32x4_t (*sums)[kDotVectors]) {
  int8x16_t levels[kPixels];
  for (int p = 0; p < kPixels; ++p)
    levels[p] = vreinterpretq_s8_u8(veorq_u8(vld1q_u8(pixels[p] + channel), vdupq_n_u8(0x80)));
  const auto add_four = [&](auto lane) STDC_DOT_PRODUCT __attribute__((always_inline)) {
    constexpr int kLane = decltype(lane)::value;
    for (int i = 0; i < kDotVectors; ++i) {
      const int8x16_t w = vld1q_s8(weights + 16 * (kLane * kDotVectors + i));
      for (int p = 0; p < kPixels; ++p) sums[p][i] = vdotq_laneq_s32(sums[p][i], w, levels[p], kLane);
    }
  };
  add_four(std::integral_constant<int, 0>());
  add_four(std::integral_constant<int, 1>());
  add_four(std::integral_constant<int, 2>());
  add_four(std::integral_constant<int, 3>());
}

/// A strip of outputs for kPixels pixels of a row.
template <int kPixels>
STDC_DOT_PRODUCT void dot_pixels(const DirectJob& job, const std::int32_t* correction, int y, int x,
                                 int first) {
  const TensorView& source = job.source;
  const int inputs = source.shape.channels, taps = job.kernel * job.kernel;
  const std::int8_t* weights =
      static_cast<const std::int8_t*>(job.weights) +
      static_cast<std::size_t>(first) * static_cast<std::size_t>(taps) * static_cast<std::size_t>(inputs);
  int32x4_t sums[kPixels][kDotVectors];
  for (auto& of_pixel : sums) {
    for (int i = 0; i < kDotVectors; ++i) of_pixel[i] = vld1q_s32(correction + first + 4 * i);
  }
  for (int tap = 0; tap < taps; ++tap) {
    const int row = y * job.stride - job.padding_before + tap / job.kernel;
    const std::uint8_t* pixels[kPixels];
    for (int p = 0; p < kPixels; ++p) {
      const int column = (x + p) * job.stride - job.padding_before + tap % job.kernel;
      const bool inside = row >= 0 && row < source.shape.height && column >= 0 && column < source.shape.width;
      pixels[p] = inside ? source.bytes() + source.offset(0, row, column)
                         : static_cast<const std::uint8_t*>(job.zeros);
    }
    for (int c = 0; c < inputs; c += kDotChannels, weights += kDotChannels * kDirectStrip)
      add_channels<kPixels>(pixels, c, weights, sums);
  }
  for (int p = 0; p < kPixels; ++p) store_dots(job, sums[p], y, x + p, first);
}

}  // namespace

bool has_dot_product() { return (getauxval(AT_HWCAP) & HWCAP_ASIMDDP) != 0; }

void run_dot_convolution(const DirectJob& job, const std::int32_t* sums) {
  constexpr int kMany = 8, kFew = 4;  // 16 sums, 8 registers of levels and 2 of weights of 32 registers
  const TensorShape& shape = job.target.shape;
  // A strip's weights stay in the first cache for all of the image.
  for (int first = 0; first < shape.channels; first += kDirectStrip) {
    for (int y = 0; y < shape.height; ++y) {
      int x = 0;
      for (; x + kMany <= shape.width; x += kMany) dot_pixels<kMany>(job, sums, y, x, first);
      for (; x + kFew <= shape.width; x += kFew) dot_pixels<kFew>(job, sums, y, x, first);
      for (; x < shape.width; ++x) dot_pixels<1>(job, sums, y, x, first);
    }
  }
}

#else

bool has_dot_product() { return false; }

void run_dot_convolution(const DirectJob&, const std::int32_t*) {}

#endif

}  // namespace stdc
