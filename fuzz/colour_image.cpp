// Colour images: PNG and JPEG, in both modes; PNGs also with their check sums put right.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/images/image_codec.hpp"
#include "png_builder.hpp"

namespace {

void decode(stdc::Bytes bytes) {
  const cv::Size image_size(40, 24);
  for (const auto mode : {stdc::ColourMode::as_stored, stdc::ColourMode::grey}) {
    const stdc::DecodedImage decoded = stdc::decode_colour(bytes, image_size, mode);
    if (decoded.image.empty() == decoded.problem.empty()) std::abort();
    if (!decoded.image.empty() && decoded.image.size() != image_size) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  decode({data, size});
  if (stdc::is_png({data, size})) {
    decode(stdc::fuzz::with_good_check_sums({data, size}));
  } else {
    decode(stdc::fuzz::wrapped({data, size}, 40, 24));
  }
  return 0;
}
