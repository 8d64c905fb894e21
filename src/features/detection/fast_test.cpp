#include "features/detection/fast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/every_target.hpp"
#include "features/test_images.hpp"

namespace stdc {
namespace {

constexpr int kCircle[16][2] = {{0, -3}, {1, -3}, {2, -2}, {3, -1}, {3, 0},  {3, 1},   {2, 2},   {1, 3},
                                {0, 3},  {-1, 3}, {-2, 2}, {-3, 1}, {-3, 0}, {-3, -1}, {-2, -2}, {-1, -3}};

// The definition, word by word.
bool is_corner(const ImageView& image, int x, int y, int threshold) {
  for (int start = 0; start < 16; ++start) {
    int brighter = 0, darker = 0;
    for (int i = start; i < start + 9; ++i) {
      const int difference = image.at(x + kCircle[i % 16][0], y + kCircle[i % 16][1]) - image.at(x, y);
      brighter += difference > threshold ? 1 : 0;
      darker += difference < -threshold ? 1 : 0;
    }
    if (brighter == 9 || darker == 9) return true;
  }
  return false;
}

int score(const ImageView& image, int x, int y) {
  int best = -1;
  for (int t = 0; t < 255 && is_corner(image, x, y, t); ++t) best = t;
  return best;
}

std::vector<Corner> brute_force(const ImageView& image, int border, int threshold) {
  std::map<std::pair<int, int>, int> scores;
  for (int y = border; y < image.height - border; ++y) {
    for (int x = border; x < image.width - border; ++x) {
      const int s = score(image, x, y);
      if (s >= threshold) scores[{y, x}] = s;
    }
  }
  std::vector<Corner> corners;
  for (const auto& [place, s] : scores) {
    bool maximal = true;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const auto neighbour = scores.find({place.first + dy, place.second + dx});
        if (neighbour == scores.end() || (dx == 0 && dy == 0)) continue;
        const bool is_before = dy < 0 || (dy == 0 && dx < 0);
        if (is_before ? neighbour->second >= s : neighbour->second > s) maximal = false;
      }
    }
    if (maximal) {
      corners.push_back({static_cast<std::int16_t>(place.second), static_cast<std::int16_t>(place.first),
                         static_cast<std::uint8_t>(s)});
    }
  }
  return corners;
}

void expect_equal(const std::vector<Corner>& actual, const std::vector<Corner>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    ASSERT_EQ(actual[i].x, expected[i].x) << i;
    ASSERT_EQ(actual[i].y, expected[i].y) << i;
    ASSERT_EQ(actual[i].score, expected[i].score) << i;
  }
}

void expect_definition(const cv::Mat& grey, int border, int threshold) {
  const PaddedImage image = test::padded(grey);
  const std::vector<Corner> expected = brute_force(image.view(), border, threshold);
  test::on_every_target([&] {
    std::vector<Corner> corners{{1, 2, 3}};
    find_fast_corners(image.view(), border, threshold, corners);
    expect_equal(corners, expected);
  });
}

TEST(Fast, IsTheDefinitionOnRectangles) {
  for (const int threshold : {1, 7, 20, 100})
    expect_definition(test::rectangles_image(161, 117, 3), 16, threshold);
}

TEST(Fast, IsTheDefinitionOnNoise) {
  expect_definition(test::noise_image(97, 83, 1), 3, 7);
  expect_definition(test::noise_image(64, 64, 2), 16, 20);
}

TEST(Fast, IsTheDefinitionOnBlackAndWhite) {
  cv::Mat image = test::noise_image(90, 70, 5);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x)
      image.at<std::uint8_t>(y, x) = image.at<std::uint8_t>(y, x) < 200 ? 0 : 255;
  }
  expect_definition(image, 3, 20);
  expect_definition(255 - image, 3, 255);
}

TEST(Fast, FindsNothingOnFlatImages) {
  for (const int grey : {0, 128, 255}) expect_definition(cv::Mat(70, 90, CV_8UC1, cv::Scalar(grey)), 3, 1);
}

TEST(Fast, HighCornersAreTheLowOnesThatReachTheThreshold) {
  const PaddedImage image = test::padded(test::rectangles_image(321, 243, 8));
  std::vector<Corner> low, high;
  find_fast_corners(image.view(), 16, 7, low);
  find_fast_corners(image.view(), 16, 20, high);
  EXPECT_GT(high.size(), 20U);
  EXPECT_GT(low.size(), high.size());
  std::erase_if(low, [](const Corner& corner) { return corner.score < 20; });
  expect_equal(low, high);
}

TEST(Fast, AnImageWithoutRoomInsideTheBorderHasNoCorners) {
  const PaddedImage image = test::padded(test::noise_image(64, 32, 4));
  std::vector<Corner> corners{{1, 2, 3}};
  find_fast_corners(image.view(), 16, 7, corners);
  EXPECT_TRUE(corners.empty());
}

}  // namespace
}  // namespace stdc
