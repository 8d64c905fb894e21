#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "core/files/text_file.hpp"
#include "input/recordings/messages/message_image.hpp"

namespace stdc {
namespace {

constexpr std::uint32_t kMaxRawSide = 16384;

/// How the pixels of an encoding lie.
struct Encoding {
  std::string_view name;
  PixelMeaning meaning;
  int type;          ///< of the bytes as they are
  int to_bgr = -1;   ///< OpenCV's conversion; -1: none needed
  int to_grey = -1;  ///< -1: by way of BGR
};

// ROS names a Bayer pattern by its first four pixels row by row; OpenCV by the second row's second and third.
constexpr std::array kEncodings{
    Encoding{"rgb8", PixelMeaning::colour, CV_8UC3, cv::COLOR_RGB2BGR, cv::COLOR_RGB2GRAY},
    Encoding{"bgr8", PixelMeaning::colour, CV_8UC3, -1, cv::COLOR_BGR2GRAY},
    Encoding{"8UC3", PixelMeaning::colour, CV_8UC3, -1, cv::COLOR_BGR2GRAY},
    Encoding{"rgba8", PixelMeaning::colour, CV_8UC4, cv::COLOR_RGBA2BGR, cv::COLOR_RGBA2GRAY},
    Encoding{"bgra8", PixelMeaning::colour, CV_8UC4, cv::COLOR_BGRA2BGR, cv::COLOR_BGRA2GRAY},
    Encoding{"8UC4", PixelMeaning::colour, CV_8UC4, cv::COLOR_BGRA2BGR, cv::COLOR_BGRA2GRAY},
    Encoding{"yuv422", PixelMeaning::colour, CV_8UC2, cv::COLOR_YUV2BGR_UYVY, cv::COLOR_YUV2GRAY_UYVY},
    Encoding{"uyvy", PixelMeaning::colour, CV_8UC2, cv::COLOR_YUV2BGR_UYVY, cv::COLOR_YUV2GRAY_UYVY},
    Encoding{"yuv422_yuy2", PixelMeaning::colour, CV_8UC2, cv::COLOR_YUV2BGR_YUY2, cv::COLOR_YUV2GRAY_YUY2},
    Encoding{"yuyv", PixelMeaning::colour, CV_8UC2, cv::COLOR_YUV2BGR_YUY2, cv::COLOR_YUV2GRAY_YUY2},
    Encoding{"bayer_rggb8", PixelMeaning::colour, CV_8UC1, cv::COLOR_BayerBG2BGR},
    Encoding{"bayer_bggr8", PixelMeaning::colour, CV_8UC1, cv::COLOR_BayerRG2BGR},
    Encoding{"bayer_gbrg8", PixelMeaning::colour, CV_8UC1, cv::COLOR_BayerGR2BGR},
    Encoding{"bayer_grbg8", PixelMeaning::colour, CV_8UC1, cv::COLOR_BayerGB2BGR},
    Encoding{"mono8", PixelMeaning::grey, CV_8UC1},
    Encoding{"8UC1", PixelMeaning::grey, CV_8UC1},
    Encoding{"y8", PixelMeaning::grey, CV_8UC1},
    Encoding{"mono16", PixelMeaning::sixteen_bits, CV_16UC1},
    Encoding{"16UC1", PixelMeaning::sixteen_bits, CV_16UC1},
    Encoding{"z16", PixelMeaning::depth, CV_16UC1},
    Encoding{"32FC1", PixelMeaning::depth, CV_32FC1},
    Encoding{"64FC1", PixelMeaning::depth, CV_64FC1},
};

bool same_name(std::string_view a, std::string_view b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(),
                    [](unsigned char s, unsigned char t) { return std::tolower(s) == std::tolower(t); });
}

const Encoding* find_encoding(std::string_view name) {
  const auto* found = std::find_if(kEncodings.begin(), kEncodings.end(),
                                   [&](const Encoding& encoding) { return same_name(encoding.name, name); });
  return found == kEncodings.end() ? nullptr : found;
}

/// Why the message cannot hold such pixels, or "".
std::string size_problem(const ImageMessage& message, const Encoding& encoding) {
  if (message.width < 1 || message.height < 1 || message.width > kMaxRawSide ||
      message.height > kMaxRawSide) {
    return fmt::format("the image claims {} x {} pixels", message.width, message.height);
  }
  const std::size_t row = message.width * static_cast<std::size_t>(CV_ELEM_SIZE(encoding.type));
  if (message.step < row || std::uint64_t{message.step} * (message.height - 1) + row > message.data.size()) {
    return fmt::format("{} x {} pixels of {} with {} bytes a row do not fit into {} bytes", message.width,
                       message.height, encoding.name, message.step, message.data.size());
  }
  return "";
}

/// Pixels of 8 bits a channel where they stand in the message. Wider ones may stand at any address and with
/// any step, which cv::Mat does not bear.
cv::Mat pixels_of(const ImageMessage& message, const Encoding& encoding) {
  auto* data = const_cast<std::uint8_t*>(message.data.data());  // cv::Mat knows no constant pixels; only read
  return {static_cast<int>(message.height), static_cast<int>(message.width), encoding.type, data,
          message.step};
}

/// Pixels with their bytes in this machine's order, in an image of their own.
template <typename Pixel>
cv::Mat in_native_order(const ImageMessage& message, int type) {
  cv::Mat image(static_cast<int>(message.height), static_cast<int>(message.width), type);
  const std::size_t row = message.width * sizeof(Pixel);
  for (int y = 0; y < image.rows; ++y) {
    std::memcpy(image.ptr(y), message.data.data() + static_cast<std::size_t>(y) * message.step, row);
    if (!message.big_endian) continue;
    for (std::size_t x = 0; x < row; x += sizeof(Pixel)) {
      std::reverse(image.ptr(y) + x, image.ptr(y) + x + sizeof(Pixel));
    }
  }
  return image;
}

cv::Mat converted(const cv::Mat& image, int code) {
  cv::Mat result;
  cv::cvtColor(image, result, code);
  return result;
}

cv::Mat in_colour(const cv::Mat& pixels, const Encoding& encoding) {
  return encoding.to_bgr >= 0 ? converted(pixels, encoding.to_bgr) : pixels.clone();
}

}  // namespace

PixelMeaning meaning_of(std::string_view encoding) {
  const Encoding* known = find_encoding(encoding);
  return known == nullptr ? PixelMeaning::unknown : known->meaning;
}

const char* known_encodings() {
  return "rgb8, bgr8, rgba8, bgra8, mono8, mono16, yuv422, yuv422_yuy2, bayer_*8 for colour, 16UC1, 32FC1 "
         "for depth";
}

bool stores_brightness(const ImageMessage& message) {
  const Encoding* encoding = find_encoding(message.encoding);
  return encoding != nullptr && encoding->type == CV_8UC2;
}

DecodedImage colour_of(const ImageMessage& message, ColourMode mode) {
  const Encoding* encoding = find_encoding(message.encoding);
  if (encoding == nullptr || encoding->meaning == PixelMeaning::depth) {
    return {{}, fmt::format("its encoding {} is none of a colour image", shown(message.encoding))};
  }
  if (std::string problem = size_problem(message, *encoding); !problem.empty())
    return {{}, std::move(problem)};
  if (encoding->meaning == PixelMeaning::sixteen_bits) {
    cv::Mat image;
    in_native_order<std::uint16_t>(message, CV_16UC1)
        .convertTo(image, CV_8U, 1.0 / 256, -0.498);  // rounds down
    return {image, ""};
  }
  const cv::Mat pixels = pixels_of(message, *encoding);
  if (encoding->type == CV_8UC2 && message.width % 2 != 0) return {{}, "4:2:2 needs an even width"};
  if (encoding->meaning == PixelMeaning::grey) return {pixels.clone(), ""};
  if (encoding->type == CV_8UC1 && (message.width < 3 || message.height < 3)) {
    return {{}, "is too small for a Bayer pattern"};
  }
  if (mode != ColourMode::grey) return {in_colour(pixels, *encoding), ""};
  if (encoding->to_grey >= 0) return {converted(pixels, encoding->to_grey), ""};
  return {converted(in_colour(pixels, *encoding), cv::COLOR_BGR2GRAY), ""};
}

DecodedImage depth_of(const ImageMessage& message) {
  const Encoding* encoding = find_encoding(message.encoding);
  if (encoding == nullptr ||
      (encoding->meaning != PixelMeaning::depth && encoding->meaning != PixelMeaning::sixteen_bits)) {
    return {{}, fmt::format("its encoding {} is none of a depth image", shown(message.encoding))};
  }
  if (std::string problem = size_problem(message, *encoding); !problem.empty())
    return {{}, std::move(problem)};
  if (encoding->type == CV_16UC1) return {in_native_order<std::uint16_t>(message, CV_16UC1), ""};
  if (encoding->type == CV_32FC1) return {in_native_order<float>(message, CV_32FC1), ""};
  cv::Mat image;
  in_native_order<double>(message, CV_64FC1).convertTo(image, CV_32F);
  return {image, ""};
}

}  // namespace stdc
