#include "input/recordings/messages/message_image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "input/recordings/messages/rvl.hpp"
#include "input/recordings/messages/test_pattern.hpp"

namespace stdc {
namespace {

using test::same_pixels;

ImageMessage message_of(const cv::Mat& image, std::string_view encoding) {
  ImageMessage message;
  message.width = static_cast<std::uint32_t>(image.cols),
  message.height = static_cast<std::uint32_t>(image.rows);
  message.encoding = encoding;
  message.step = static_cast<std::uint32_t>(image.step);
  message.data = {image.data, image.step * static_cast<std::size_t>(image.rows)};
  return message;
}

cv::Mat converted(const cv::Mat& image, int code) {
  cv::Mat result;
  cv::cvtColor(image, result, code);
  return result;
}

cv::Mat colour(const ImageMessage& message, ColourMode mode = ColourMode::as_stored) {
  const DecodedImage decoded = colour_of(message, mode);
  EXPECT_EQ(decoded.problem, "");
  return decoded.image;
}

TEST(RawImage, ColourEncodings) {
  const cv::Mat bgr = test::pattern_colour(1), grey = converted(bgr, cv::COLOR_BGR2GRAY);
  EXPECT_TRUE(same_pixels(colour(message_of(bgr, "bgr8")), bgr));
  EXPECT_TRUE(same_pixels(colour(message_of(bgr, "8UC3")), bgr));
  EXPECT_TRUE(same_pixels(colour(message_of(bgr, "bgr8"), ColourMode::grey), grey));
  for (const auto& [encoding, code] :
       {std::pair{"rgb8", cv::COLOR_BGR2RGB}, std::pair{"rgba8", cv::COLOR_BGR2RGBA},
        std::pair{"bgra8", cv::COLOR_BGR2BGRA}}) {
    const cv::Mat stored = converted(bgr, code);
    EXPECT_TRUE(same_pixels(colour(message_of(stored, encoding)), bgr)) << encoding;
    EXPECT_TRUE(same_pixels(colour(message_of(stored, encoding), ColourMode::grey), grey)) << encoding;
  }
  EXPECT_TRUE(same_pixels(colour(message_of(grey, "mono8")), grey));
  EXPECT_TRUE(same_pixels(colour(message_of(grey, "8UC1")), grey));
}

TEST(RawImage, LumaOf422IsTheStoredOne) {
  cv::Mat uyvy(4, 6, CV_8UC2), yuyv(4, 6, CV_8UC2), luma(4, 6, CV_8UC1);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 6; ++x) {
      const auto value = static_cast<std::uint8_t>(30 * y + 10 * x);
      luma.at<std::uint8_t>(y, x) = value;
      uyvy.at<cv::Vec2b>(y, x) = {128, value};
      yuyv.at<cv::Vec2b>(y, x) = {value, 128};
    }
  }
  for (const char* encoding : {"yuv422", "uyvy", "UYVY"}) {
    EXPECT_TRUE(same_pixels(colour(message_of(uyvy, encoding), ColourMode::grey), luma)) << encoding;
    EXPECT_EQ(colour(message_of(uyvy, encoding)).type(), CV_8UC3);
  }
  EXPECT_TRUE(same_pixels(colour(message_of(yuyv, "yuv422_yuy2"), ColourMode::grey), luma));
  // No chroma: a grey.
  const auto pixel = colour(message_of(yuyv, "yuyv")).at<cv::Vec3b>(2, 2);
  EXPECT_TRUE(pixel[0] == pixel[1] && pixel[1] == pixel[2]);
}

TEST(RawImage, BayerPatternsOfOneColourAreThatColour) {
  constexpr std::uint8_t kRed = 200, kGreen = 100, kBlue = 50;
  for (const std::string pattern : {"rggb", "bggr", "gbrg", "grbg"}) {
    cv::Mat raw(8, 8, CV_8UC1);
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        const char c = pattern[static_cast<std::size_t>(2 * (y % 2) + x % 2)];
        raw.at<std::uint8_t>(y, x) = c == 'r' ? kRed : c == 'g' ? kGreen : kBlue;
      }
    }
    const cv::Mat bgr = colour(message_of(raw, "bayer_" + pattern + "8"));
    EXPECT_EQ(bgr.at<cv::Vec3b>(4, 4), cv::Vec3b(kBlue, kGreen, kRed)) << pattern;
    EXPECT_EQ(bgr.at<cv::Vec3b>(3, 4), cv::Vec3b(kBlue, kGreen, kRed)) << pattern;
  }
}

TEST(RawImage, RowsMayBeLongerAndAtAnyAddress) {
  const cv::Mat depth = test::pattern_depth(2);
  const std::size_t row = depth.cols * 2, step = row + 7;
  std::vector<std::uint8_t> bytes(1 + step * static_cast<std::size_t>(depth.rows));
  for (int y = 0; y < depth.rows; ++y) {
    std::memcpy(bytes.data() + 1 + static_cast<std::size_t>(y) * step, depth.ptr(y), row);
  }
  ImageMessage message = message_of(depth, "16UC1");
  message.step = static_cast<std::uint32_t>(step);
  message.data = Bytes(bytes).subspan(1);
  EXPECT_TRUE(same_pixels(depth_of(message).image, depth));
  message.data = message.data.first(step * 47 + row - 1);
  EXPECT_NE(depth_of(message).problem.find("do not fit into"), std::string::npos);
  message.width = 0xFFFFFFFF;
  EXPECT_NE(depth_of(message).problem.find("claims"), std::string::npos);
}

TEST(RawImage, DepthOfEitherByteOrder) {
  const cv::Mat depth = test::pattern_depth(2);
  cv::Mat swapped = depth.clone();
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const std::uint16_t value = depth.at<std::uint16_t>(y, x);
      swapped.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(value << 8U | value >> 8U);
    }
  }
  ImageMessage message = message_of(swapped, "mono16");
  message.big_endian = true;
  EXPECT_TRUE(same_pixels(depth_of(message).image, depth));
  cv::Mat metres;
  depth.convertTo(metres, CV_32F, 1e-3);
  EXPECT_TRUE(same_pixels(depth_of(message_of(metres, "32FC1")).image, metres));
  EXPECT_EQ(colour(message_of(depth, "16UC1")).at<std::uint8_t>(20, 20),
            depth.at<std::uint16_t>(20, 20) / 256);
  EXPECT_NE(depth_of(message_of(test::pattern_colour(0), "rgb8")).problem.find("'rgb8' is none of a depth"),
            std::string::npos);
  EXPECT_NE(colour_of(message_of(metres, "32FC1"), ColourMode::grey).problem.find("none of a colour"),
            std::string::npos);
}

TEST(CompressedImage, RedAndBlueMayBeSwappedInTheFile) {
  const cv::Mat bgr = test::pattern_colour(1);
  const std::vector<std::uint8_t> png = encode_png(bgr);
  const CompressedImageMessage plain{{}, "bgr8; png compressed bgr8", png};
  EXPECT_TRUE(same_pixels(colour_of(plain, ColourMode::as_stored).image, bgr));
  const std::vector<std::uint8_t> swapped = encode_png(converted(bgr, cv::COLOR_BGR2RGB));
  const CompressedImageMessage rgb{{}, "rgb8; png compressed rgb8", swapped};
  EXPECT_TRUE(same_pixels(colour_of(rgb, ColourMode::as_stored).image, bgr));
  EXPECT_TRUE(same_pixels(colour_of(rgb, ColourMode::grey).image, converted(bgr, cv::COLOR_BGR2GRAY)));
  const CompressedImageMessage none{{}, "tiff", Bytes(png).subspan(5)};
  EXPECT_NE(colour_of(none, ColourMode::grey).problem.find("no JPEG or PNG"), std::string::npos);
}

std::vector<std::uint8_t> with_depth_header(const std::vector<std::uint8_t>& data, float a, float b) {
  std::vector<std::uint8_t> bytes(12);
  std::memcpy(bytes.data() + 4, &a, 4);
  std::memcpy(bytes.data() + 8, &b, 4);
  bytes.insert(bytes.end(), data.begin(), data.end());
  return bytes;
}

TEST(CompressedImage, CompressedDepth) {
  const cv::Mat depth = test::pattern_depth(1);
  const std::vector<std::uint8_t> png = encode_png(depth), whole = with_depth_header(png, 0, 0);
  EXPECT_TRUE(
      same_pixels(depth_of(CompressedImageMessage{{}, "16UC1; compressedDepth png", whole}).image, depth));
  EXPECT_TRUE(
      same_pixels(depth_of(CompressedImageMessage{{}, "16UC1; compressedDepth", whole}).image, depth));
  EXPECT_TRUE(same_pixels(depth_of(CompressedImageMessage{{}, "16UC1; png compressed ", png}).image, depth));
  const std::vector<std::uint8_t> inverse = with_depth_header(png, 10100, -100);
  const cv::Mat metres = depth_of(CompressedImageMessage{{}, "32FC1; compressedDepth png", inverse}).image;
  ASSERT_EQ(metres.type(), CV_32FC1);
  EXPECT_TRUE(std::isnan(metres.at<float>(0, 0)));
  EXPECT_NEAR(metres.at<float>(20, 20), 10100.0 / (depth.at<std::uint16_t>(20, 20) + 100.0), 1e-5);
  const std::vector<std::uint8_t> nothing = with_depth_header(png, 0, 0);
  EXPECT_NE(depth_of(CompressedImageMessage{{}, "32FC1; compressedDepth png", nothing}).problem.find("scale"),
            std::string::npos);
  EXPECT_NE(depth_of(CompressedImageMessage{{}, "16UC1; compressedDepth png", Bytes(whole).first(7)}).problem,
            "");
}

/// RVL as the paper describes it.
std::vector<std::uint8_t> encode_rvl(const cv::Mat& depth) {
  std::vector<std::uint32_t> groups;
  const auto put = [&](std::uint32_t value) {
    do {
      groups.push_back((value & 7U) | (value > 7 ? 8U : 0U));
      value >>= 3U;
    } while (value != 0);
  };
  const auto* pixels = depth.ptr<std::uint16_t>();
  const std::size_t count = depth.total();
  int previous = 0;
  for (std::size_t at = 0; at < count;) {
    std::size_t zeros = 0, values = 0;
    while (at + zeros < count && pixels[at + zeros] == 0) ++zeros;
    at += zeros;
    while (at + values < count && pixels[at + values] != 0) ++values;
    put(static_cast<std::uint32_t>(zeros));
    put(static_cast<std::uint32_t>(values));
    for (const std::size_t end = at + values; at < end; ++at) {
      const int delta = pixels[at] - previous;
      put(static_cast<std::uint32_t>(delta >= 0 ? 2 * delta : -2 * delta - 1));
      previous = pixels[at];
    }
  }
  std::vector<std::uint8_t> bytes;
  groups.resize((groups.size() + 7) / 8 * 8);
  for (std::size_t i = 0; i < groups.size(); i += 8) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 8; ++k) word = word << 4U | groups[i + k];
    for (unsigned k = 0; k < 4; ++k) bytes.push_back(static_cast<std::uint8_t>(word >> (8 * k)));
  }
  return bytes;
}

TEST(Rvl, ReadsBackWhatWasWrittenAfterThePaper) {
  const cv::Mat depth = test::pattern_depth(3);
  const std::vector<std::uint8_t> bytes = encode_rvl(depth);
  EXPECT_TRUE(same_pixels(decode_rvl(bytes, depth.size()).image, depth));
  for (std::size_t size = 0; size + 4 < bytes.size(); size += 4) {
    EXPECT_NE(decode_rvl(Bytes(bytes).first(size), depth.size()).problem, "") << size;
  }
  std::vector<std::uint8_t> message(8);
  const std::int32_t width = depth.cols, height = depth.rows;
  std::memcpy(message.data(), &width, 4);
  std::memcpy(message.data() + 4, &height, 4);
  message.insert(message.end(), bytes.begin(), bytes.end());
  const std::vector<std::uint8_t> whole = with_depth_header(message, 0, 0);
  EXPECT_TRUE(
      same_pixels(depth_of(CompressedImageMessage{{}, "16UC1; compressedDepth rvl", whole}).image, depth));
}

}  // namespace
}  // namespace stdc
