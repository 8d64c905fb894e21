#pragma once

#include <optional>

#include "core/images/image_codec.hpp"

namespace stdc {

/// The size that a PNG (its IHDR chunk) or a JPEG (its first frame header) says it has; nothing if the bytes
/// are neither, end too early, or say zero or more than 16384 a side. For images whose size is not known from
/// elsewhere: the codecs of image_codec.hpp want to be told it.
std::optional<cv::Size> image_size(Bytes bytes);

}  // namespace stdc
