#include "dense/inpainting/mask_growth.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "dense/inpainting/test_plane.hpp"

namespace stdc {
namespace {

using test::PlaneScene;

/// A thing at 1 m before a wall at 2 m, of which the mask has only the upper half.
class MaskGrowthTest : public testing::Test {
 protected:
  MaskGrowthTest() {
    depth_ = cv::Mat(120, 160, CV_32FC1, cv::Scalar(PlaneScene::kWall));
    depth_(thing_) = PlaneScene::kMover;
    half_ = PlaneScene::mask({60, 30, 30, 20});
  }
  SplatDepth knows(float metres) const {
    return {cv::Mat(depth_.size(), CV_32FC1, cv::Scalar(metres)),
            cv::Mat(depth_.size(), CV_32FC1, cv::Scalar(0))};
  }
  cv::Mat grow(const std::vector<SplatDepth>& splats, const std::vector<float>& votes) const {
    return grow_mask(depth_, half_, zone_, splats, votes, {});
  }

  const cv::Rect thing_{60, 30, 30, 40};
  cv::Mat depth_, half_, zone_ = cv::Mat(120, 160, CV_8UC1, cv::Scalar(255));
};

TEST_F(MaskGrowthTest, TheRestOfTheThingIsAddedAndNothingElse) {
  const cv::Mat mask = grow({knows(PlaneScene::kWall)}, {1});
  EXPECT_EQ(cv::norm(mask, PlaneScene::mask(thing_), cv::NORM_INF), 0);
}

TEST_F(MaskGrowthTest, WhatViewsKnowInItsPlaceStays) {
  EXPECT_EQ(cv::norm(grow({knows(PlaneScene::kMover)}, {1}), half_, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(grow({knows(0)}, {1}), half_, cv::NORM_INF), 0) << "nobody has looked there";
}

TEST_F(MaskGrowthTest, TheHeavierVoteDecides) {
  const std::vector<SplatDepth> splats{knows(PlaneScene::kWall), knows(PlaneScene::kMover)};
  EXPECT_EQ(cv::countNonZero(grow(splats, {1, 0.5F})), thing_.area());
  EXPECT_EQ(cv::countNonZero(grow(splats, {0.5F, 1})), cv::countNonZero(half_));
}

TEST_F(MaskGrowthTest, NotBeyondTheZone) {
  zone_.rowRange(60, 120) = 0;
  const cv::Mat mask = grow({knows(PlaneScene::kWall)}, {1});
  EXPECT_EQ(cv::countNonZero(mask), 30 * 30);
}

TEST_F(MaskGrowthTest, NotAcrossAHoleInTheDepth) {
  depth_.row(55) = 0;
  EXPECT_EQ(cv::countNonZero(grow({knows(PlaneScene::kWall)}, {1})), 30 * 25);
}

}  // namespace
}  // namespace stdc
