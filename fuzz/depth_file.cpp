// Depth in NPY, TIFF and EXR files.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "input/depth_formats/depth_formats.hpp"

namespace {

void decode(stdc::Bytes bytes, cv::Size size) {
  const stdc::DecodedImage decoded = stdc::decode_any_depth(bytes, size);
  if (decoded.image.empty() == decoded.problem.empty()) std::abort();
  if (decoded.image.empty()) return;
  if (decoded.image.type() != CV_16UC1 && decoded.image.type() != CV_32FC1) std::abort();
  if (!size.empty() && decoded.image.size() != size) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  decode({data, size}, {7, 5});
  decode({data, size}, {});
  return 0;
}
