#include "core/images/image_size.hpp"
#include "input/depth_formats/depth_formats.hpp"

namespace stdc {

DecodedImage decode_any_depth(Bytes bytes, cv::Size size) {
  if (is_npy(bytes)) return decode_npy_depth(bytes, size);
  if (is_tiff(bytes)) return decode_tiff_depth(bytes, size);
  if (is_exr(bytes)) return decode_exr_depth(bytes, size);
  // Of bytes that say no size the decoder of PNGs knows what is wrong.
  return decode_depth(bytes, size.empty() ? image_size(bytes).value_or(cv::Size(1, 1)) : size);
}

}  // namespace stdc
