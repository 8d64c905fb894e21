#include "segmentation/network/network_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.hpp"

namespace stdc {
namespace {

constexpr float kWhite = 255;

}  // namespace

NetworkInput::NetworkInput(const NetworkWeights& weights, cv::Size size, NetworkPrecision precision)
    : size_(size), mean_(weights.mean), deviation_(weights.deviation) {
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t v = 0; v < 256; ++v) {
      normalised_[c][v] = (static_cast<float>(v) / kWhite - mean_[c]) / deviation_[c];
    }
  }
  if (precision == NetworkPrecision::int8) {
    view_ = {{3, size.height + 1, size.width + 1}, ElementType::u8, 3, 3, nullptr};
    memory_ = aligned_memory(view_.shape.elements());
    view_.data = memory_.get();
    for (std::size_t i = 0; i < view_.shape.elements(); ++i) {
      view_.bytes()[i] = static_cast<std::uint8_t>(std::lround(mean_[i % 3] * kWhite));
    }
  } else {
    view_ = {{3, size.height, size.width}, ElementType::f32, 1, 1, nullptr};
    memory_ = aligned_memory(view_.shape.elements() * sizeof(float));
    view_.data = memory_.get();
  }
}

ConvolutionWeights NetworkInput::adapt(const ConvolutionWeights& first) const {
  ConvolutionWeights layer = first;
  if (!is_int8()) return layer;
  const auto taps = static_cast<std::size_t>(first.kernel * first.kernel);
  for (std::size_t o = 0; o < layer.bias.size(); ++o) {
    double shift = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t t = 0; t < taps; ++t) {
        float& weight = layer.weights[(o * 3 + c) * taps + t];
        weight /= deviation_[c];
        shift += static_cast<double>(weight) * mean_[c];
        weight /= kWhite;
      }
    }
    layer.bias[o] = static_cast<float>(layer.bias[o] - shift);
  }
  return layer;
}

void NetworkInput::set(const cv::Mat& bgr) {
  if (bgr.size() != size_ || bgr.type() != CV_8UC3) {
    throw Error("input of the network",
                fmt::format("is not a colour image of {}x{} pixels", size_.width, size_.height),
                "resize it first");
  }
  const std::size_t pixels = view_.shape.pixels();
  for (int y = 0; y < size_.height; ++y) {
    const std::uint8_t* from = bgr.ptr(y);
    if (is_int8()) {
      std::uint8_t* to = view_.bytes() + view_.offset(0, y + 1, 1);
      for (int i = 0; i < 3 * size_.width; i += 3) {
        to[i] = from[i + 2], to[i + 1] = from[i + 1], to[i + 2] = from[i];
      }
      continue;
    }
    float* to = view_.floats() + view_.offset(0, y, 0);
    for (int x = 0; x < size_.width; ++x, from += 3, ++to) {
      for (std::size_t c = 0; c < 3; ++c) to[c * pixels] = normalised_[c][from[2 - c]];
    }
  }
}

void NetworkInput::set(std::span<const float> normalised) {
  if (is_int8() || normalised.size() != view_.shape.elements()) {
    throw Error("input of the network", "is not what the network was made for",
                "give 3 x height x width numbers to a network in fp32");
  }
  std::copy(normalised.begin(), normalised.end(), view_.floats());
}

}  // namespace stdc
