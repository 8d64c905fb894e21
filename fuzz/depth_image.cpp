// Depth images: 16-bit PNG; also with their check sums put right.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/images/image_codec.hpp"
#include "png_builder.hpp"

namespace {

void decode(stdc::Bytes bytes) {
  const stdc::DecodedImage decoded = stdc::decode_depth(bytes, {40, 24});
  if (decoded.image.empty() == decoded.problem.empty()) std::abort();
  if (!decoded.image.empty() && decoded.image.type() != CV_16UC1) std::abort();
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
