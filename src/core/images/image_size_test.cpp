#include "core/images/image_size.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

TEST(ImageSize, IsThatOfTheImage) {
  const cv::Mat image(31, 1025, CV_8UC3, cv::Scalar(1, 2, 3));
  EXPECT_EQ(image_size(encode_png(image)), cv::Size(1025, 31));
  EXPECT_EQ(image_size(encode_jpeg(image)), cv::Size(1025, 31));
}

TEST(ImageSize, IsNothingForWhatIsNoImage) {
  const cv::Mat image(31, 65, CV_8UC1, cv::Scalar(9));
  EXPECT_FALSE(image_size({}));
  EXPECT_FALSE(image_size(std::vector<std::uint8_t>(100, 7)));
  for (auto bytes : {encode_png(image), encode_jpeg(image)}) {
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const auto size = image_size(Bytes(bytes).first(length));
      EXPECT_EQ(size.value_or(cv::Size(65, 31)), cv::Size(65, 31)) << length;
      EXPECT_FALSE(size && length < 20);
    }
  }
  auto png = encode_png(image);
  png[16] = 200;  // a width of billions
  EXPECT_FALSE(image_size(png));
}

}  // namespace
}  // namespace stdc
