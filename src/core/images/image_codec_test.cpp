#include "core/images/image_codec.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/random.hpp"

namespace stdc {
namespace {

/// A smooth image with some noise, as cameras give.
cv::Mat picture(cv::Size size, int type) {
  Random random(7);
  cv::Mat image(size, type);
  const int channels = image.channels();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      for (int c = 0; c < channels; ++c) {
        const int value = 3 * x + 2 * y + 20 * c + static_cast<int>(random.below(8));
        if (image.depth() == CV_16U) {
          image.ptr<std::uint16_t>(y)[x] = static_cast<std::uint16_t>(100 * value);
        } else {
          image.ptr(y)[x * channels + c] = static_cast<std::uint8_t>(value % 200);
        }
      }
    }
  }
  return image;
}

double max_difference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

constexpr int kWidth = 40, kHeight = 24;
const cv::Size kSize(kWidth, kHeight);

TEST(ImageCodec, PngKeepsEveryValue) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    const cv::Mat image = picture(kSize, type);
    const DecodedImage decoded = decode_colour(encode_png(image), kSize, ColourMode::as_stored);
    ASSERT_EQ(decoded.problem, "");
    ASSERT_EQ(decoded.image.type(), type);
    EXPECT_EQ(max_difference(decoded.image, image), 0);
  }
  const cv::Mat depth = picture(kSize, CV_16UC1);
  const DecodedImage decoded = decode_depth(encode_png(depth), kSize);
  ASSERT_EQ(decoded.image.type(), CV_16UC1);
  EXPECT_EQ(max_difference(decoded.image, depth), 0);
}

TEST(ImageCodec, JpegIsNear) {
  cv::Mat image(kSize, CV_8UC3);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) image.at<cv::Vec3b>(y, x) = cv::Vec3b(40 + x, 90 + y, 200 - x);
  }
  const DecodedImage decoded = decode_colour(encode_jpeg(image, 95), kSize, ColourMode::as_stored);
  ASSERT_EQ(decoded.problem, "");
  ASSERT_EQ(decoded.image.type(), CV_8UC3);
  EXPECT_LT(max_difference(decoded.image, image), 12);
  cv::Mat grey(kSize, CV_8UC1, cv::Scalar(77));
  const DecodedImage grey_again = decode_colour(encode_jpeg(grey), kSize, ColourMode::as_stored);
  ASSERT_EQ(grey_again.image.type(), CV_8UC1);
  EXPECT_LT(max_difference(grey_again.image, grey), 2);
}

TEST(ImageCodec, GreyModeGivesTheLuma) {
  const cv::Mat image(kSize, CV_8UC3, cv::Scalar(200, 100, 50));  // blue, green, red
  const double luma = 0.114 * 200 + 0.587 * 100 + 0.299 * 50;
  for (const auto& bytes : {encode_png(image), encode_jpeg(image, 98)}) {
    const DecodedImage decoded = decode_colour(bytes, kSize, ColourMode::grey);
    ASSERT_EQ(decoded.problem, "");
    ASSERT_EQ(decoded.image.type(), CV_8UC1);
    EXPECT_NEAR(decoded.image.at<std::uint8_t>(5, 5), luma, 1.5);
  }
}

TEST(ImageCodec, EveryTruncationIsNoticed) {
  const std::vector<std::vector<std::uint8_t>> files{
      encode_png(picture(kSize, CV_8UC3)), encode_png(picture(kSize, CV_8UC1)),
      encode_jpeg(picture(kSize, CV_8UC3)), encode_jpeg(picture(kSize, CV_8UC1))};
  for (const auto& file : files) {
    for (std::size_t length = 0; length < file.size(); ++length) {
      const DecodedImage decoded = decode_colour(Bytes(file).first(length), kSize, ColourMode::as_stored);
      EXPECT_NE(decoded.problem, "") << length << " of " << file.size();
      EXPECT_TRUE(decoded.image.empty());
    }
  }
  const auto depth = encode_png(picture(kSize, CV_16UC1));
  for (std::size_t length = 0; length < depth.size(); ++length) {
    EXPECT_NE(decode_depth(Bytes(depth).first(length), kSize).problem, "") << length;
  }
}

TEST(ImageCodec, EveryChangedByteOfAPngIsNoticed) {
  const cv::Mat image = picture(kSize, CV_16UC1);
  const auto file = encode_png(image);
  for (std::size_t i = 0; i < file.size(); ++i) {
    auto damaged = file;
    damaged[i] ^= 0x10;
    EXPECT_NE(decode_depth(damaged, kSize).problem, "") << i;
  }
}

TEST(ImageCodec, NoChangedByteOfAJpegDoesHarm) {
  const auto file = encode_jpeg(picture(kSize, CV_8UC3));
  int noticed = 0;
  for (std::size_t i = 0; i < file.size(); ++i) {
    auto damaged = file;
    damaged[i] ^= 0xFF;
    const DecodedImage decoded = decode_colour(damaged, kSize, ColourMode::as_stored);
    EXPECT_EQ(decoded.image.empty(), !decoded.problem.empty());
    noticed += decoded.image.empty() ? 1 : 0;
  }
  EXPECT_GT(noticed, 0);
}

TEST(ImageCodec, SaysWhatIsWrong) {
  const auto colour = encode_png(picture(kSize, CV_8UC3));
  const auto depth = encode_png(picture(kSize, CV_16UC1));
  EXPECT_EQ(decode_colour(colour, {64, 48}, ColourMode::as_stored).problem,
            "is 40 x 24 pixels, but the camera has 64 x 48");
  EXPECT_EQ(decode_colour(encode_jpeg(picture(kSize, CV_8UC3)), {64, 48}, ColourMode::as_stored).problem,
            "is 40 x 24 pixels, but the camera has 64 x 48");
  EXPECT_EQ(decode_depth(colour, kSize).problem,
            "has 3 channel(s) of 8 bits, but one of 16 (grey) is needed");
  EXPECT_EQ(decode_depth(encode_png(picture(kSize, CV_8UC1)), kSize).problem,
            "has 1 channel(s) of 8 bits, but one of 16 (grey) is needed");
  EXPECT_EQ(decode_colour(depth, kSize, ColourMode::as_stored).problem,
            "has 1 channel(s) of 16 bits, but 1 or 3 of 8 (grey or RGB) is needed");
  EXPECT_NE(decode_depth(encode_jpeg(picture(kSize, CV_8UC1)), kSize).problem.find("is not a PNG"),
            std::string::npos);
  EXPECT_EQ(decode_colour({}, kSize, ColourMode::as_stored).problem, "the file is empty");
  const std::vector<std::uint8_t> text{'h', 'e', 'l', 'l', 'o', ' ', 'y', 'o', 'u'};
  EXPECT_EQ(decode_colour(text, kSize, ColourMode::as_stored).problem, "is neither a PNG nor a JPEG image");
}

}  // namespace
}  // namespace stdc
