#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/files/text_file.hpp"
#include "core/images/image_size.hpp"
#include "input/recordings/containers/byte_reader.hpp"
#include "input/recordings/messages/message_image.hpp"
#include "input/recordings/messages/rvl.hpp"

namespace stdc {
namespace {

constexpr int kMaxPackedSide = 16384;

/// The parts of a compressedDepth message.
struct DepthPack {
  bool inverse = false;  ///< 32FC1: quantised inverse depth
  bool rvl = false;      ///< else PNG
  float a = 0, b = 0;    ///< depth = a / (value - b)
  Bytes data;
  cv::Size size;  ///< empty if it cannot be told
};

DepthPack unpack_header(const CompressedImageMessage& message) {
  DepthPack pack;
  ByteReader reader(message.data);
  reader.number<std::int32_t>();
  pack.a = reader.number<float>();
  pack.b = reader.number<float>();
  pack.inverse = message.format.starts_with("32FC1");
  pack.rvl = message.format.find("rvl") != std::string_view::npos;
  if (pack.rvl) {
    const auto width = reader.number<std::int32_t>(), height = reader.number<std::int32_t>();
    if (width > 0 && height > 0 && width <= kMaxPackedSide && height <= kMaxPackedSide)
      pack.size = {width, height};
  }
  if (reader.ok()) pack.data = reader.bytes(reader.left());
  if (!pack.rvl) pack.size = image_size(pack.data).value_or(cv::Size());
  return pack;
}

cv::Mat metres_of(const cv::Mat& inverse, float a, float b) {
  cv::Mat depth(inverse.size(), CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    const auto* from = inverse.ptr<std::uint16_t>(y);
    auto* to = depth.ptr<float>(y);
    for (int x = 0; x < depth.cols; ++x) {
      to[x] = from[x] == 0 ? std::numeric_limits<float>::quiet_NaN() : a / (static_cast<float>(from[x]) - b);
    }
  }
  return depth;
}

/// Red and blue stand in each other's place in the file: its brightness is another one, too.
bool is_swapped(const CompressedImageMessage& message) {
  return message.format.find("compressed rgb8") != std::string_view::npos;
}

}  // namespace

bool is_compressed_depth(std::string_view format) {
  return format.find("compressedDepth") != std::string_view::npos;
}

std::optional<cv::Size> size_of(const CompressedImageMessage& message) {
  if (!is_compressed_depth(message.format)) return image_size(message.data);
  const cv::Size size = unpack_header(message).size;
  return size.empty() ? std::nullopt : std::optional(size);
}

bool stores_brightness(const CompressedImageMessage& message) {
  return is_jpeg(message.data) && !is_swapped(message);
}

DecodedImage colour_of(const CompressedImageMessage& message, ColourMode mode) {
  const std::optional<cv::Size> size = size_of(message);
  if (!size) {
    return {{}, fmt::format("is no JPEG or PNG that can be read (its format: {})", shown(message.format))};
  }
  const bool swapped = is_swapped(message);
  DecodedImage decoded = decode_colour(message.data, *size, swapped ? ColourMode::as_stored : mode);
  if (!swapped || decoded.image.channels() != 3) return decoded;
  cv::Mat image;
  cv::cvtColor(decoded.image, image, mode == ColourMode::grey ? cv::COLOR_RGB2GRAY : cv::COLOR_RGB2BGR);
  return {image, ""};
}

DecodedImage depth_of(const CompressedImageMessage& message) {
  if (!is_compressed_depth(message.format)) {
    const std::optional<cv::Size> size = size_of(message);
    if (!size || !is_png(message.data)) {
      return {{}, fmt::format("is no 16-bit PNG (its format: {})", shown(message.format))};
    }
    return decode_depth(message.data, *size);
  }
  const DepthPack pack = unpack_header(message);
  if (pack.size.empty()) return {{}, "its compressedDepth ends too early or claims an impossible size"};
  DecodedImage decoded = pack.rvl ? decode_rvl(pack.data, pack.size) : decode_depth(pack.data, pack.size);
  if (!decoded.problem.empty() || !pack.inverse) return decoded;
  if (!(std::isfinite(pack.a) && std::isfinite(pack.b) && pack.a > 0)) {
    return {{}, "its compressedDepth has no valid scale"};
  }
  return {metres_of(decoded.image, pack.a, pack.b), ""};
}

}  // namespace stdc
