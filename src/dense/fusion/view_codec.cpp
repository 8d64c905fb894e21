#include "dense/fusion/view_codec.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/images/image_codec.hpp"

namespace stdc {

void encode_view(const FusedDepth& fused, float max_depth, const cv::Mat& colour, DenseView& view) {
  constexpr int kQuality = 85;
  cv::Mat steps(fused.depth.size(), CV_16UC1);
  const auto* z = fused.depth.ptr<float>();
  auto* out = steps.ptr<std::uint16_t>();
  for (std::size_t i = 0; i < steps.total(); ++i) {
    const float inverse = z[i] > 0 && z[i] <= max_depth ? kInverseDepthSteps / z[i] + 0.5F : 0.F;
    out[i] = static_cast<std::uint16_t>(std::min(inverse, 65535.F));
  }
  view.depth = encode_png(steps, PngEffort::fast);
  view.support = encode_png(fused.support, PngEffort::fast);
  view.colour = encode_jpeg(colour, kQuality);
  // The encoder takes room for images that do not get smaller; views are kept by the hundred.
  view.depth.shrink_to_fit();
  view.support.shrink_to_fit();
}

FusedDepth decode_depth(const DenseView& view, cv::Size size) {
  FusedDepth fused;
  return decode_depth(view, size, fused) ? fused : FusedDepth();
}

bool decode_depth(const DenseView& view, cv::Size size, FusedDepth& fused) {
  const cv::Mat steps = decode_png_depth(view.depth, size).image;
  fused.support = decode_png_colour(view.support, size, ColourMode::grey).image;
  if (steps.empty() || fused.support.empty()) return false;
  fused.depth.create(size, CV_32FC1);
  const auto* in = steps.ptr<std::uint16_t>();
  auto* z = fused.depth.ptr<float>();
  for (std::size_t i = 0; i < steps.total(); ++i) {
    z[i] = in[i] > 0 ? kInverseDepthSteps / static_cast<float>(in[i]) : 0.F;
  }
  return true;
}

cv::Mat decode_colour(const DenseView& view, cv::Size size) {
  cv::Mat colour = decode_jpeg(view.colour, size, ColourMode::as_stored).image;
  if (colour.channels() == 1 && !colour.empty()) cv::cvtColor(colour, colour, cv::COLOR_GRAY2BGR);
  return colour;
}

}  // namespace stdc
