#include "core/orientation.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/images/test_exif.hpp"

namespace stdc {
namespace {

using test::exif_data;
using test::FileBytes;

FileBytes jpeg_with(const FileBytes& data) {
  return test::jpeg_with_exif(encode_jpeg(cv::Mat(8, 12, CV_8UC3, cv::Scalar(1, 2, 3))), data);
}

FileBytes png_with(const FileBytes& data) {
  return test::png_with_exif(encode_png(cv::Mat(8, 12, CV_8UC3, cv::Scalar(1, 2, 3))), data);
}

TEST(Orientation, IsReadFromExif) {
  for (int value = 1; value <= 8; ++value) {
    for (const bool little_endian : {true, false}) {
      EXPECT_EQ(exif_orientation(jpeg_with(exif_data(value, little_endian))), Orientation{value});
      EXPECT_EQ(exif_orientation(png_with(exif_data(value, little_endian))), Orientation{value});
    }
  }
  EXPECT_EQ(exif_orientation(encode_jpeg(cv::Mat(8, 12, CV_8UC3, cv::Scalar(1, 2, 3)))),
            Orientation::upright);
  EXPECT_EQ(exif_orientation({}), Orientation::upright);
  EXPECT_EQ(decode_colour(png_with(exif_data(6)), {12, 8}, ColourMode::as_stored).problem, "");
}

TEST(Orientation, DamagedExifIsNoOrientation) {
  EXPECT_EQ(exif_orientation(jpeg_with(exif_data(9, true))), Orientation::upright);
  EXPECT_EQ(exif_orientation(jpeg_with(exif_data(0, true))), Orientation::upright);
  for (const FileBytes& file : {jpeg_with(exif_data(6, true)), png_with(exif_data(6, false))}) {
    for (std::size_t length = 0; length < file.size(); ++length) {
      const FileBytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length));
      exif_orientation(cut);  // ends, and reads nothing beyond
    }
    for (std::size_t i = 0; i < file.size(); ++i) {
      FileBytes damaged = file;
      damaged[i] ^= 0xFF;
      const int value = static_cast<int>(exif_orientation(damaged));
      EXPECT_TRUE(value >= 1 && value <= 8);
    }
  }
}

TEST(Orientation, TurnsAsExifSays) {
  // Where the stored image's top left pixel goes, by the names of the standard: value 1 = top left ...
  cv::Mat stored(4, 6, CV_8UC1, cv::Scalar(0));
  stored.at<std::uint8_t>(0, 0) = 1, stored.at<std::uint8_t>(0, 5) = 2;
  struct Expected {
    int value;
    cv::Point first, second;
  };
  for (const Expected& e :
       {Expected{1, {0, 0}, {5, 0}}, Expected{2, {5, 0}, {0, 0}}, Expected{3, {5, 3}, {0, 3}},
        Expected{4, {0, 3}, {5, 3}}, Expected{5, {0, 0}, {0, 5}}, Expected{6, {3, 0}, {3, 5}},
        Expected{7, {3, 5}, {3, 0}}, Expected{8, {0, 5}, {0, 0}}}) {
    const cv::Mat upright = to_upright(stored, Orientation{e.value});
    ASSERT_EQ(upright.size(), swaps_sides(Orientation{e.value}) ? cv::Size(4, 6) : cv::Size(6, 4)) << e.value;
    EXPECT_EQ(upright.at<std::uint8_t>(e.first), 1) << e.value;
    EXPECT_EQ(upright.at<std::uint8_t>(e.second), 2) << e.value;
    EXPECT_EQ(cv::norm(from_upright(upright, Orientation{e.value}), stored), 0) << e.value;
  }
}

TEST(Orientation, RotationIsClockwise) {
  EXPECT_EQ(orientation_of_rotation(0), Orientation::upright);
  cv::Mat stored(4, 6, CV_8UC1, cv::Scalar(0));
  stored.at<std::uint8_t>(0, 0) = 1;
  EXPECT_EQ(to_upright(stored, orientation_of_rotation(90)).at<std::uint8_t>(0, 3), 1) << "to the top right";
  EXPECT_EQ(to_upright(stored, orientation_of_rotation(180)).at<std::uint8_t>(3, 5), 1);
  EXPECT_EQ(to_upright(stored, orientation_of_rotation(270)).at<std::uint8_t>(5, 0), 1);
}

}  // namespace
}  // namespace stdc
