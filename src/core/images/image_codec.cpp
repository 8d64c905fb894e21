#include "core/images/image_codec.hpp"

namespace stdc {

DecodedImage decode_colour(Bytes bytes, cv::Size size, ColourMode mode) {
  if (is_jpeg(bytes)) return decode_jpeg(bytes, size, mode);
  if (is_png(bytes)) return decode_png_colour(bytes, size, mode);
  return {{}, bytes.empty() ? "the file is empty" : "is neither a PNG nor a JPEG image"};
}

DecodedImage decode_depth(Bytes bytes, cv::Size size) {
  if (is_png(bytes)) return decode_png_depth(bytes, size);
  return {{}, bytes.empty() ? "the file is empty" : "is not a PNG image (depth must be a 16-bit grey PNG)"};
}

}  // namespace stdc
