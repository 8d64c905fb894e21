// Colour images: PNG and JPEG, in both modes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/image_codec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const cv::Size image_size(40, 24);
  for (const auto mode : {stdc::ColourMode::as_stored, stdc::ColourMode::grey}) {
    const stdc::DecodedImage decoded = stdc::decode_colour({data, size}, image_size, mode);
    if (decoded.image.empty() == decoded.problem.empty()) std::abort();
    if (!decoded.image.empty() && decoded.image.size() != image_size) std::abort();
  }
  return 0;
}
