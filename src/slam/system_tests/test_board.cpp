#include "slam/system_tests/test_board.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/random.hpp"
#include "slam/system_tests/test_sequence.hpp"

namespace stdc::test {

Board::Board(int width, int height, double depth, std::uint64_t seed, double contrast)
    : depth_(depth), texture_(height, width, CV_8UC3) {
  Random random(seed);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c)
        texture_.at<cv::Vec3b>(y, x)[c] = static_cast<std::uint8_t>(random.below(256));
    }
  }
  cv::GaussianBlur(texture_, texture_, {}, 2);
  cv::normalize(texture_, texture_, 128 - 128 * contrast, 128 + 127 * contrast, cv::NORM_MINMAX);
}

void Board::paste(RgbdImage& image, int left, int top) const {
  const double units = TestSequence::of_a_room().camera.depth_units_per_metre;
  const auto depth = static_cast<std::uint16_t>(depth_ * units);
  for (int y = std::max(top, 0); y < std::min(top + texture_.rows, image.colour.rows); ++y) {
    for (int x = std::max(left, 0); x < std::min(left + texture_.cols, image.colour.cols); ++x) {
      std::uint16_t& there = image.depth.at<std::uint16_t>(y, x);
      if (there != 0 && there < depth) continue;
      there = depth;
      image.colour.at<cv::Vec3b>(y, x) = texture_.at<cv::Vec3b>(y - top, x - left);
    }
  }
}

}  // namespace stdc::test
