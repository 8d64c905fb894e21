#include "input/depth_formats/depth_formats.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "input/depth_formats/test_depth_files.hpp"

namespace stdc {
namespace {

Bytes bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

DecodedImage decode(const std::string& text, cv::Size size = {}) {
  return decode_any_depth(bytes_of(text), size);
}

TEST(DepthFormats, NpyOfAllTypes) {
  const std::string shape = "(2, 3)";
  const auto units = decode(test::make_npy<std::uint16_t>("<u2", shape, {1, 2, 3, 4, 5, 65535}));
  ASSERT_EQ(units.problem, "");
  EXPECT_EQ(units.image.type(), CV_16UC1);
  EXPECT_EQ(units.image.size(), cv::Size(3, 2));
  EXPECT_EQ(units.image.at<std::uint16_t>(1, 2), 65535);
  const auto metres = decode(test::make_npy<float>("<f4", shape, {1.5F, 2, 3, 4, 5, 6}), {3, 2});
  EXPECT_EQ(metres.image.at<float>(0, 0), 1.5F);
  EXPECT_EQ(decode(test::make_npy<double>("<f8", shape, {1.5, 2, 3, 4, 5, 6})).image.at<float>(1, 0), 4);
  const auto half =
      decode(test::make_npy<std::uint16_t>("<f2", shape, {0x3e00, 0x3c00, 0x7e00, 0xc000, 1, 0}));
  EXPECT_EQ(half.image.at<float>(0, 0), 1.5F);
  EXPECT_EQ(half.image.at<float>(1, 0), -2);
  EXPECT_TRUE(std::isnan(half.image.at<float>(0, 2)));
  EXPECT_FLOAT_EQ(half.image.at<float>(1, 1), 5.9604645e-8F);
  EXPECT_EQ(decode(test::make_npy<std::uint16_t>(">u2", shape, {0x0100, 2, 3, 4, 5, 6}))
                .image.at<std::uint16_t>(0, 0),
            1);
  EXPECT_EQ(decode(test::make_npy<float>("<f4", "(1, 2, 3)", {1, 2, 3, 4, 5, 6})).image.at<float>(1, 0), 4);
  EXPECT_EQ(decode(test::make_npy<float>("<f4", shape, {1, 2, 3, 4, 5, 6}, true)).image.at<float>(1, 0), 2);
}

TEST(DepthFormats, NpySaysWhatIsWrong) {
  const std::string whole = test::make_npy<float>("<f4", "(2, 3)", {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(decode(whole.substr(0, whole.size() - 1)).problem, "the NPY ends too early");
  EXPECT_EQ(decode(whole.substr(0, 20)).problem, "is no NPY of a two-dimensional array");
  EXPECT_EQ(decode(whole, {640, 480}).problem, "is 3 x 2 pixels, but the camera has 640 x 480");
  EXPECT_NE(decode(test::make_npy<float>("<i8", "(2, 3)", {})).problem.find("of the type <i8"),
            std::string::npos);
  EXPECT_EQ(decode(test::make_npy<float>("<f4", "(2000000000, 3)", {})).problem,
            "says that it is 3 x 2000000000 pixels");
  EXPECT_EQ(decode(test::make_npy<float>("<f4", "(6,)", {})).problem, "is no NPY of a two-dimensional array");
}

#ifdef STDC_WITH_TIFF
TEST(DepthFormats, Tiff) {
  cv::Mat units(5, 7, CV_16UC1), metres(5, 7, CV_32FC1);
  cv::randu(units, 1, 60000);
  cv::randu(metres, 0.1, 9.0);
  for (const bool tiled : {false, true}) {
    for (const cv::Mat& image : {units, metres}) {
      const DecodedImage decoded = decode(test::make_tiff(image, tiled), {7, 5});
      ASSERT_EQ(decoded.problem, "");
      EXPECT_EQ(cv::norm(decoded.image, image, cv::NORM_INF), 0);
    }
  }
  const std::string whole = test::make_tiff(units, false);
  EXPECT_EQ(decode(whole.substr(0, 60)).problem, "the TIFF is damaged");
  EXPECT_EQ(decode(whole, {8, 5}).problem, "is 7 x 5 pixels, but the camera has 8 x 5");
  EXPECT_NE(
      decode(test::make_tiff(cv::Mat(5, 7, CV_8UC1, cv::Scalar(1)), false)).problem.find("of 1 x 8 bits"),
      std::string::npos);
}
#else
TEST(DepthFormats, TiffWithoutItsLibrarySaysSo) {
  EXPECT_NE(decode(std::string("II*\0", 4)).problem.find("built without libtiff"), std::string::npos);
}
#endif

#ifdef STDC_WITH_EXR
TEST(DepthFormats, Exr) {
  const std::vector<float> pixels{0.5F, 1.25F, 3, 4, INFINITY, 6};
  for (const char* channel : {"Z", "R", "Y"}) {
    const DecodedImage decoded = decode(test::make_exr(3, 2, channel, pixels), {3, 2});
    ASSERT_EQ(decoded.problem, "") << channel;
    EXPECT_EQ(decoded.image.type(), CV_32FC1);
    for (int i = 0; i < 6; ++i)
      EXPECT_EQ(decoded.image.at<float>(i / 3, i % 3), pixels[static_cast<std::size_t>(i)]);
  }
  const std::string whole = test::make_exr(3, 2, "Z", pixels);
  EXPECT_EQ(decode(whole.substr(0, whole.size() - 3)).problem, "the EXR is damaged");
  EXPECT_EQ(decode(whole.substr(0, 30)).problem, "the EXR is damaged");
  EXPECT_EQ(decode(whole, {8, 5}).problem, "is 3 x 2 pixels, but the camera has 8 x 5");
}
#else
TEST(DepthFormats, ExrWithoutItsLibrarySaysSo) {
  EXPECT_NE(decode("\x76\x2f\x31\x01").problem.find("built without OpenEXR"), std::string::npos);
}
#endif

}  // namespace
}  // namespace stdc
