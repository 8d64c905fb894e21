#include "segmentation/upright_segmenter.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace stdc {
namespace {

/// Finds the bright pixels of the upper half, and remembers the size that it was shown.
class UpperHalf final : public Segmenter {
 public:
  explicit UpperHalf(cv::Size& shown) : shown_(shown) {}
  cv::Mat segment(const SegmenterInput& input) override {
    shown_ = input.colour.size();
    if (input.frame < 0) return {};
    cv::Mat mask = input.colour > 128;
    mask.rowRange(mask.rows / 2, mask.rows).setTo(0);
    return mask;
  }
  int delay() const override { return 3; }

 private:
  cv::Size& shown_;
};

TEST(UprightSegmenter, TurnsTheImageAndTheMaskBack) {
  // The camera lies on its side: what is up in the world is on the left.
  cv::Mat image(4, 8, CV_8UC1, cv::Scalar(0));
  image.at<std::uint8_t>(1, 1) = 255;  // in the upper half of the world
  image.at<std::uint8_t>(1, 6) = 255;  // in the lower
  cv::Size shown;
  UprightSegmenter segmenter(std::make_unique<UpperHalf>(shown), orientation_of_rotation(90));
  const cv::Mat mask = segmenter.segment({image, 0, 0});
  EXPECT_EQ(shown, cv::Size(4, 8));
  ASSERT_EQ(mask.size(), image.size());
  EXPECT_EQ(mask.at<std::uint8_t>(1, 1), 255);
  EXPECT_EQ(cv::countNonZero(mask), 1);
  EXPECT_TRUE(segmenter.segment({image, 0, -1}).empty());
  EXPECT_EQ(segmenter.delay(), 3);
}

}  // namespace
}  // namespace stdc
