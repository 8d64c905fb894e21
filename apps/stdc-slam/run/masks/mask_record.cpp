#include "run/masks/mask_record.hpp"

#include "core/images/image_codec.hpp"

namespace stdc::app {

void MaskRecord::on_frame(const ObservedFrame& frame) {
  const cv::Mat& mask = frame.result.dynamic_mask;
  masks_.emplace_back();
  if (!mask.empty()) masks_.back() = {mask.size(), encode_png(mask, PngEffort::fast)};
}

cv::Mat MaskRecord::mask(int frame) const {
  if (frame < 0 || frame >= static_cast<int>(masks_.size())) return {};
  const Compressed& one = masks_[static_cast<std::size_t>(frame)];
  if (one.png.empty()) return {};
  return decode_png_colour(one.png, one.size, ColourMode::grey).image;
}

}  // namespace stdc::app
