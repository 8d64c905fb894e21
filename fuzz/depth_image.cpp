// Depth images: 16-bit PNG.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/image_codec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const cv::Size image_size(40, 24);
  const stdc::DecodedImage decoded = stdc::decode_depth({data, size}, image_size);
  if (decoded.image.empty() == decoded.problem.empty()) std::abort();
  if (!decoded.image.empty() && decoded.image.type() != CV_16UC1) std::abort();
  return 0;
}
