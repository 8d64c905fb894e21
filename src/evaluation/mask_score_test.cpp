#include "evaluation/mask_score.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/error.hpp"

namespace stdc {
namespace {

constexpr int kWidth = 320, kHeight = 240;  // outlines are near within ceil(0.008 * 400) = 4 px

cv::Mat box(const cv::Rect& area) {
  cv::Mat mask(kHeight, kWidth, CV_8UC1, cv::Scalar(0));
  mask(area) = 255;
  return mask;
}

TEST(MaskScore, IsOneForTheTruth) {
  const cv::Mat mask = box({100, 50, 60, 80});
  const MaskScores scores = score_mask(count_mask(mask, mask));
  EXPECT_EQ(scores.iou, 1);
  EXPECT_EQ(scores.precision, 1);
  EXPECT_EQ(scores.recall, 1);
  EXPECT_EQ(scores.boundary_f, 1);
}

TEST(MaskScore, CountsPixels) {
  const MaskScores scores = score_mask(count_mask(box({100, 50, 60, 80}), box({120, 50, 60, 80})));
  EXPECT_DOUBLE_EQ(*scores.iou, 40.0 / 80);
  EXPECT_DOUBLE_EQ(*scores.precision, 40.0 / 60);
  EXPECT_DOUBLE_EQ(*scores.recall, 40.0 / 60);
  // Of each outline (276 px) the 40 px that lie on the other's count, above and below, and the next 4 both
  // along these lines and down the sides.
  EXPECT_DOUBLE_EQ(*scores.boundary_f, 2 * (40 + 4 + 4) / 276.0);
}

TEST(MaskScore, OutlinesWithinTheToleranceAreNear) {
  const cv::Mat truth = box({100, 50, 60, 80});
  EXPECT_EQ(score_mask(count_mask(box({104, 50, 60, 80}), truth)).boundary_f, 1);
  EXPECT_LT(*score_mask(count_mask(box({105, 50, 60, 80}), truth)).boundary_f, 1);
  EXPECT_EQ(score_mask(count_mask(box({10, 200, 20, 20}), truth)).boundary_f, 0);
}

TEST(MaskScore, TheImageBorderIsNoOutline) {
  EXPECT_EQ(count_mask(box({0, 0, kWidth, kHeight}), box({0, 0, 10, kHeight})).mask_boundary, 0);
  EXPECT_EQ(count_mask(box({0, 0, 10, kHeight}), box({0, 0, 1, 1})).mask_boundary, kHeight);
}

TEST(MaskScore, IsNotDefinedForNothing) {
  const cv::Mat nothing = box({}), something = box({5, 5, 20, 20});
  const MaskScores none = score_mask(count_mask(nothing, nothing));
  EXPECT_FALSE(none.iou || none.precision || none.recall || none.boundary_f);
  const MaskScores missed = score_mask(count_mask(nothing, something));
  EXPECT_EQ(missed.iou, 0);
  EXPECT_FALSE(missed.precision);
  EXPECT_EQ(missed.recall, 0);
  EXPECT_EQ(missed.boundary_f, 0);
}

TEST(MaskScore, LeavesOutIgnoredPixels) {
  const cv::Mat truth = box({100, 50, 60, 80}), ignore = box({160, 0, 160, kHeight});
  const MaskCounts counts = count_mask(box({100, 50, 150, 80}), truth, ignore);
  EXPECT_EQ(counts.mask_only, 0);
  EXPECT_EQ(score_mask(counts).iou, 1);
  EXPECT_EQ(score_mask(counts).boundary_f, 1);
}

TEST(MaskScore, AddsUpAndAverages) {
  MaskCounts sum = count_mask(box({0, 0, 10, 10}), box({0, 0, 10, 10}));
  sum += count_mask(box({0, 0, 10, 10}), box({20, 20, 10, 10}));
  EXPECT_DOUBLE_EQ(*score_mask(sum).iou, 100.0 / 300);
  const MaskScores mean = mean_scores({{1.0, {}, 0.5, 1.0}, {0.5, {}, {}, 0.0}});
  EXPECT_EQ(mean.iou, 0.75);
  EXPECT_FALSE(mean.precision);
  EXPECT_EQ(mean.recall, 0.5);
  EXPECT_EQ(mean.boundary_f, 0.5);
  EXPECT_FALSE(mean_scores({}).iou);
}

TEST(MaskScore, RefusesOtherSizes) {
  EXPECT_THROW(count_mask(box({}), cv::Mat(3, 3, CV_8UC1)), Error);
  EXPECT_THROW(count_mask(box({}), cv::Mat(kHeight, kWidth, CV_8UC3)), Error);
  EXPECT_THROW(count_mask({}, {}), Error);
}

}  // namespace
}  // namespace stdc
