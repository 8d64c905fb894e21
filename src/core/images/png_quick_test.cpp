#include "core/images/png_quick.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <opencv2/core.hpp>

#include "core/random.hpp"

namespace stdc {
namespace {

/// Everything that a PNG can vary in.
struct Kind {
  int type;    // of the cv::Mat: CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1
  int colour;  // PNG_COLOR_TYPE_...
  int bits = 8;
  int filters = PNG_ALL_FILTERS;
  int interlace = PNG_INTERLACE_NONE;
};

void append(png_structp png, png_bytep from, std::size_t count) {
  auto* bytes = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  bytes->insert(bytes->end(), from, from + count);
}

/// Encodes with libpng; pixels of 16 bits and palette indices are written as they lie in memory.
std::vector<std::uint8_t> encode(const cv::Mat& image, const Kind& kind, int chunk_size = 8192) {
  std::vector<std::uint8_t> bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append, [](png_structp) {});
  png_set_IHDR(png, info, static_cast<unsigned>(image.cols), static_cast<unsigned>(image.rows), kind.bits,
               kind.colour, kind.interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  std::vector<png_color> palette;
  for (int i = 0; i < 256; ++i) {
    palette.push_back(
        {static_cast<png_byte>(i), static_cast<png_byte>(255 - i), static_cast<png_byte>(i / 2)});
  }
  if (kind.colour == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), 256);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, kind.filters);
  png_set_compression_buffer_size(png, static_cast<std::size_t>(chunk_size));
  png_write_info(png, info);
  if (image.channels() >= 3) png_set_bgr(png);
  if (kind.bits == 16) png_set_swap(png);
  std::vector<png_bytep> rows;
  for (int y = 0; y < image.rows; ++y) rows.push_back(const_cast<png_bytep>(image.ptr(y)));
  png_write_image(png, rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

/// Smooth with noise and flat parts, so that every filter is the best somewhere.
cv::Mat test_picture(cv::Size size, int type) {
  Random random(3);
  cv::Mat image(size, type, cv::Scalar::all(0));
  const int channels = image.channels();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width * channels; ++x) {
      const int noise = y % 7 < 3 ? static_cast<int>(random.below(y % 5 == 0 ? 250 : 4)) : 0;
      const int value = y % 11 == 0 ? 17 : 5 * x + 3 * y + noise;
      if (image.depth() == CV_16U) {
        image.ptr<std::uint16_t>(y)[x] = static_cast<std::uint16_t>(37 * value);
      } else {
        image.ptr(y)[x] = static_cast<std::uint8_t>(value);
      }
    }
  }
  return image;
}

TEST(DecodePngQuickly, UndoesEveryFilter) {
  for (const cv::Size size : {cv::Size(67, 45), cv::Size(1, 9), cv::Size(200, 1)}) {
    for (const int filters : {PNG_FILTER_NONE, PNG_FILTER_SUB, PNG_FILTER_UP, PNG_FILTER_AVG,
                              PNG_FILTER_PAETH, PNG_ALL_FILTERS}) {
      for (const Kind& kind :
           {Kind{CV_8UC1, PNG_COLOR_TYPE_GRAY, 8, filters}, Kind{CV_8UC3, PNG_COLOR_TYPE_RGB, 8, filters},
            Kind{CV_16UC1, PNG_COLOR_TYPE_GRAY, 16, filters}}) {
        const cv::Mat image = test_picture(size, kind.type);
        const auto decoded = decode_png_quickly(encode(image, kind, 100), size);
        ASSERT_TRUE(decoded);
        ASSERT_EQ(decoded->image.type(), kind.type);
        EXPECT_EQ(cv::norm(decoded->image, image, cv::NORM_INF), 0) << filters;
      }
    }
  }
}

TEST(DecodePngQuickly, LeavesUnusualKindsToLibpng) {
  const cv::Size size(67, 45);
  for (const Kind& kind : {Kind{CV_8UC4, PNG_COLOR_TYPE_RGB_ALPHA}, Kind{CV_8UC1, PNG_COLOR_TYPE_PALETTE},
                           Kind{CV_8UC3, PNG_COLOR_TYPE_RGB, 8, PNG_ALL_FILTERS, PNG_INTERLACE_ADAM7}}) {
    const cv::Mat image = test_picture(size, kind.type);
    const auto bytes = encode(image, kind);
    EXPECT_FALSE(decode_png_quickly(bytes, size));
    const DecodedImage decoded = decode_png_colour(bytes, size, ColourMode::as_stored);
    ASSERT_EQ(decoded.problem, "");
    ASSERT_EQ(decoded.image.type(), CV_8UC3);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const auto seen = decoded.image.at<cv::Vec3b>(y, x);
        const std::uint8_t* stored = image.ptr(y) + image.channels() * x;
        const int blue = kind.colour == PNG_COLOR_TYPE_PALETTE ? stored[0] / 2 : stored[0];
        ASSERT_EQ(seen[0], blue) << x << " " << y;
      }
    }
  }
}

TEST(DecodePngQuickly, TakesNothingDamaged) {
  const cv::Size size(67, 45);
  const auto file = encode(test_picture(size, CV_16UC1), {CV_16UC1, PNG_COLOR_TYPE_GRAY, 16}, 500);
  ASSERT_TRUE(decode_png_quickly(file, size));
  for (std::size_t length = 0; length < file.size(); ++length) {
    EXPECT_FALSE(decode_png_quickly(Bytes(file).first(length), size)) << length;
  }
  for (std::size_t i = 0; i < file.size(); ++i) {
    auto damaged = file;
    damaged[i] ^= 0x04;
    EXPECT_FALSE(decode_png_quickly(damaged, size)) << i;
  }
  EXPECT_FALSE(decode_png_quickly(file, {45, 67}));
}

}  // namespace
}  // namespace stdc
