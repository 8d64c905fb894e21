#include "features/detection/pyramid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/every_target.hpp"
#include "features/detection/resize.hpp"
#include "features/test_images.hpp"

namespace stdc {
namespace {

const FeatureSettings kImprovedPyramid{.selection = Selection::improved};
const FeatureSettings kClassicPyramid{.selection = Selection::orb_slam3};

TEST(Pyramid, LevelCountIsEquation2) {
  EXPECT_EQ(level_count(kImprovedPyramid, {640, 480}), 6);
  EXPECT_EQ(level_count(kImprovedPyramid, {480, 650}), 7);
  EXPECT_EQ(level_count(kImprovedPyramid, {1920, 1080}), 19);
  EXPECT_EQ(level_count(kImprovedPyramid, {64, 49}), 1);
  EXPECT_EQ(level_count(kImprovedPyramid, {10, 10}), 1);
  EXPECT_EQ(level_count(kClassicPyramid, {640, 480}), 8);
  EXPECT_EQ(level_count({.selection = Selection::orb_slam3, .levels = 3}, {640, 480}), 3);
}

TEST(Pyramid, BudgetsOfTheImprovedSelectionFollowEquation5) {
  const std::vector<cv::Size> sizes = level_sizes(kImprovedPyramid, {640, 480});
  const std::vector<int> budgets = level_budgets(kImprovedPyramid, sizes);
  ASSERT_EQ(budgets.size(), 6U);
  const double s2 = 1 / 1.44;
  for (int i = 0; i < 6; ++i) {
    const double expected = 1000 * (1 - s2) / (1 - std::pow(s2, 6)) * std::pow(s2, i);
    EXPECT_NEAR(budgets[static_cast<std::size_t>(i)], expected, 1) << i;
  }
}

TEST(Pyramid, BudgetsOfTheClassicSelectionFollowTheScale) {
  const std::vector<int> budgets = level_budgets(kClassicPyramid, level_sizes(kClassicPyramid, {640, 480}));
  ASSERT_EQ(budgets.size(), 8U);
  for (std::size_t i = 1; i < 8; ++i) EXPECT_NEAR(budgets[i], budgets[i - 1] / 1.2, 1.5) << i;
}

TEST(Pyramid, BudgetsAlwaysAddUp) {
  for (const Selection selection : {Selection::improved, Selection::orb_slam3}) {
    for (const cv::Size size :
         {cv::Size(640, 480), cv::Size(641, 477), cv::Size(64, 64), cv::Size(1920, 70)}) {
      for (int keypoints = 50; keypoints < 2500; keypoints += 37) {
        const FeatureSettings settings{.selection = selection, .keypoints = keypoints};
        const std::vector<cv::Size> sizes = level_sizes(settings, size);
        const std::vector<int> budgets = level_budgets(settings, sizes);
        EXPECT_EQ(std::accumulate(budgets.begin(), budgets.end(), 0), keypoints);
        for (std::size_t i = 0; i < sizes.size(); ++i) {
          const bool has_room = std::min(sizes[i].width, sizes[i].height) > 2 * kBorder;
          EXPECT_EQ(budgets[i] > 0, has_room && budgets[i] != 0);
          EXPECT_GE(budgets[i], 0);
        }
      }
    }
  }
}

// The definition in floating point.
double sample(const cv::Mat& image, double x, double y) {
  const int x0 = std::min(static_cast<int>(x), image.cols - 2),
            y0 = std::min(static_cast<int>(y), image.rows - 2);
  const double u = x - x0, v = y - y0;
  const auto at = [&](int column, int row) {
    return static_cast<double>(image.at<std::uint8_t>(row, column));
  };
  return (1 - v) * ((1 - u) * at(x0, y0) + u * at(x0 + 1, y0)) +
         v * ((1 - u) * at(x0, y0 + 1) + u * at(x0 + 1, y0 + 1));
}

void expect_shrunk(cv::Size size, double factor) {
  SCOPED_TRACE(factor);
  const cv::Mat grey = test::noise_image(size.width, size.height, 11);
  const PaddedImage source = test::padded(grey);
  const cv::Size target_size = level_sizes({.scale_factor = factor, .levels = 2}, size)[1];
  test::on_every_target([&] {
    PaddedImage target;
    target.resize(target_size.width, target_size.height, source.stride());
    shrink(source.view(), factor, target);
    for (int y = 0; y < target.height(); ++y) {
      for (int x = 0; x < target.width(); ++x) {
        const double u = (x + 0.5) * factor - 0.5, v = (y + 0.5) * factor - 0.5;
        ASSERT_LE(u, size.width - 1);
        ASSERT_LE(v, size.height - 1);
        // Weights are rounded to 1/128 each way.
        ASSERT_NEAR(target.row(y)[x], sample(grey, u, v), 0.51 + 2 * 255.0 / 256) << x << ' ' << y;
      }
    }
  });
}

TEST(Pyramid, ShrinkingIsBilinearAtPixelCentres) {
  for (const double factor : {1.05, 1.2, 1.37, 1.5, 1.99, 2.0}) expect_shrunk({131, 77}, factor);
  expect_shrunk({64, 64}, 1.2);
  expect_shrunk({2, 2}, 1.2);
}

TEST(Pyramid, KeepsRampsInPlace) {
  // Grey level = 2 * x: the levels must show it at the mapped coordinate.
  cv::Mat grey(64, 120, CV_8UC1);
  for (int x = 0; x < grey.cols; ++x) grey.col(x) = static_cast<std::uint8_t>(2 * x);
  Pyramid pyramid;
  pyramid.build(grey, {.levels = 4});
  for (int i = 0; i < pyramid.levels(); ++i) {
    const auto scale = static_cast<float>(std::pow(1.2, i));
    for (int x = 0; x < pyramid.level(i).width(); ++x) {
      ASSERT_NEAR(pyramid.level(i).row(20)[x], 2 * level_to_image(static_cast<float>(x), scale), 1.1);
    }
  }
}

TEST(Pyramid, FlatStaysFlat) {
  for (const int value : {0, 1, 127, 128, 254, 255}) {
    Pyramid pyramid;
    pyramid.build(cv::Mat(200, 300, CV_8UC1, cv::Scalar(value)), {.levels = 8});
    for (int i = 0; i < 8; ++i) {
      for (int y = 0; y < pyramid.level(i).height(); ++y) {
        for (int x = 0; x < pyramid.level(i).width(); ++x) ASSERT_EQ(pyramid.level(i).row(y)[x], value);
      }
    }
  }
}

}  // namespace
}  // namespace stdc
