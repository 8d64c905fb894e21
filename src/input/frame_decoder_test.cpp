#include "input/frame_decoder.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace stdc {
namespace {

/// A colour image whose brightness is stored apart, or not.
class MadeUpColours final : public PackedImages {
 public:
  explicit MadeUpColours(bool stores_brightness) : stores_brightness_(stores_brightness) {}
  cv::Mat colour(cv::Size size, ColourMode mode) const override {
    return mode == ColourMode::grey ? cv::Mat(size, CV_8UC1, cv::Scalar(77))
                                    : cv::Mat(size, CV_8UC3, cv::Scalar(1, 2, 3));
  }
  bool stores_brightness() const override { return stores_brightness_; }
  cv::Mat depth(cv::Size size) const override { return {size, CV_16UC1, cv::Scalar(5000)}; }

 private:
  bool stores_brightness_;
};

TEST(FrameDecoder, GivesTheStoredBrightnessBesideTheColours) {
  RgbdCameras cameras;
  cameras.colour.width = 8, cameras.colour.height = 6;
  const FrameDecoder decoder(cameras);
  SourceFrame frame;
  frame.images = std::make_shared<MadeUpColours>(true);
  const RgbdImage both = decoder.decode(frame, ColourMode::as_stored);
  EXPECT_EQ(both.colour.channels(), 3);
  ASSERT_EQ(both.grey.size(), cv::Size(8, 6));
  EXPECT_EQ(both.grey.at<std::uint8_t>(0, 0), 77);
  EXPECT_TRUE(decoder.decode(frame, ColourMode::grey).grey.empty()) << "it is the colour image already";
  frame.images = std::make_shared<MadeUpColours>(false);
  EXPECT_TRUE(decoder.decode(frame, ColourMode::as_stored).grey.empty());
}

}  // namespace
}  // namespace stdc
