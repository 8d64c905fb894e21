#include "run/masks/saved_masks.hpp"

#include <fmt/format.h>

#include "core/images/image_codec.hpp"

namespace stdc::app {

void SavedMasks::on_frame(const ObservedFrame& frame) {
  const TrackingResult& result = frame.result;
  if (result.dynamic_mask.empty()) return;
  folder_.write(fmt::format("{:.6f}.png", result.timestamp), encode_png(result.dynamic_mask));
}

}  // namespace stdc::app
