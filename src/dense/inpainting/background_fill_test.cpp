#include "dense/inpainting/background_fill.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <opencv2/core.hpp>

#include "dense/inpainting/test_plane.hpp"

namespace stdc {
namespace {

using test::PlaneScene;

const cv::Rect kWanted(60, 40, 30, 30);

class BackgroundFillTest : public testing::Test {
 protected:
  void add(double x, float vote = 1, cv::Rect mover = {}, bool masked = true, cv::Vec3f gain = {1, 1, 1}) {
    views_.push_back(make_view(PlaneScene::image(x, mover, 1 / static_cast<double>(gain[0])),
                               PlaneScene::mask(masked ? mover : cv::Rect()), 2,
                               {0, 0, MapId{0}, PlaneScene::world_from_cam(x)}, rays_));
    AlignedView aligned;
    aligned.view = &views_.back();
    aligned.view_from_frame = PlaneScene::world_from_cam(x).inverse();
    aligned.gain = gain;
    splats_.push_back(splat_depth(aligned, region_, rays_));
    aligned_.push_back(aligned);
    votes_.push_back(vote);
  }
  BackgroundFill fill() const { return fill_background(aligned_, splats_, votes_, region_, rays_, {}); }
  static double worst(const cv::Mat& colour) {
    return cv::norm(colour(kWanted), PlaneScene::image(0).colour(kWanted), cv::NORM_INF);
  }

  RayTable rays_{PlaneScene::camera()};
  const cv::Mat region_ = PlaneScene::mask(kWanted);
  std::deque<BackgroundView> views_;
  std::vector<AlignedView> aligned_;
  std::vector<SplatDepth> splats_;
  std::vector<float> votes_;
};

TEST_F(BackgroundFillTest, ShowsTheWallAsTheViewsDo) {
  add(0.1);
  add(-0.2);
  const BackgroundFill result = fill();
  EXPECT_EQ(cv::countNonZero(result.known), kWanted.area());
  EXPECT_LE(worst(result.colour), 5);
  EXPECT_NEAR(cv::mean(result.depth(kWanted))[0], PlaneScene::kWall, 1e-3);
}

TEST_F(BackgroundFillTest, ExposureIsMatched) {
  add(0.1, 1, {}, true, {1.25F, 1.25F, 1.25F});
  EXPECT_LE(worst(fill().colour), 7);
}

TEST_F(BackgroundFillTest, AViewThatStillHasTheMoverIsOutvoted) {
  add(0, 1, kWanted, false);  // the preferred one, unmasked
  add(0.1);
  add(-0.1);
  const BackgroundFill result = fill();
  EXPECT_LE(worst(result.colour), 6);
  EXPECT_NEAR(cv::mean(result.depth(kWanted))[0], PlaneScene::kWall, 0.01);
}

TEST_F(BackgroundFillTest, TheNewerVoteDecidesBetweenTwo) {
  add(0, 1, kWanted, false);  // a thing that has been put there: what stands there now
  add(0.001, 0.3F);
  EXPECT_NEAR(cv::mean(fill().depth(kWanted))[0], PlaneScene::kMover, 0.01);
}

TEST_F(BackgroundFillTest, WhatNoViewShowsIsNotKnown) {
  add(0, 1, {60, 40, 20, 30});
  const BackgroundFill result = fill();
  EXPECT_EQ(result.known.at<std::uint8_t>(55, 66), 0);
  EXPECT_EQ(result.depth.at<float>(55, 66), 0);
  EXPECT_EQ(result.known.at<std::uint8_t>(55, 86), 255);
}

}  // namespace
}  // namespace stdc
