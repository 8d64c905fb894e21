#include "dense/inpainting/background_view.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

#include "dense/inpainting/test_plane.hpp"

namespace stdc {
namespace {

using test::PlaneScene;

class BackgroundViewTest : public testing::Test {
 protected:
  RayTable rays_{PlaneScene::camera()};
  const ViewPose at_{7, 0.5, MapId{0}, PlaneScene::world_from_cam(0)};
};

TEST_F(BackgroundViewTest, WhatMovesAndItsMarginAreNotSeen) {
  const cv::Rect mover(60, 40, 30, 30);
  const BackgroundView view = make_view(PlaneScene::image(0, mover), PlaneScene::mask(mover), 4, at_, rays_);
  EXPECT_EQ(view.seen_at(75, 55), Seen::nothing);
  EXPECT_EQ(view.seen_at(57, 55), Seen::nothing) << "the margin";
  EXPECT_EQ(view.seen_at(54, 55), Seen::surface);
  EXPECT_EQ(view.at.frame, 7);
  // The mover's depth is not to be found anywhere, not as a guess either.
  double nearest = 0;
  cv::minMaxLoc(view.depth, &nearest);
  EXPECT_NEAR(nearest, PlaneScene::kWall, 1e-3);
  for (const Eigen::Vector3f& point : view.points) EXPECT_NEAR(point.z(), PlaneScene::kWall, 1e-3);
}

TEST_F(BackgroundViewTest, AHoleInTheDepthIsAGuessAndSaysSo) {
  RgbdImage image = PlaneScene::image(0);
  image.depth(cv::Rect(20, 20, 10, 10)) = 0;
  const BackgroundView view = make_view(image, {}, 4, at_, rays_);
  EXPECT_EQ(view.seen_at(25, 25), Seen::colour);
  EXPECT_NEAR(view.depth.at<float>(25, 25), PlaneScene::kWall, 0.01);
  EXPECT_EQ(view.seen_at(40, 25), Seen::surface);
}

TEST_F(BackgroundViewTest, DepthsInMetresAreTakenAsTheyAreButForWhatIsNone) {
  RgbdImage image = PlaneScene::image(0);
  image.depth = cv::Mat(120, 160, CV_32FC1, cv::Scalar(1.5));
  image.depth.at<float>(0, 0) = std::numeric_limits<float>::quiet_NaN();
  image.depth.at<float>(0, 1) = -1;
  image.depth.at<float>(0, 2) = std::numeric_limits<float>::infinity();
  const cv::Mat depth = depth_in_metres(image, rays_);
  for (int x = 0; x < 3; ++x) EXPECT_EQ(depth.at<float>(0, x), 0) << x;
  EXPECT_EQ(depth.at<float>(0, 3), 1.5F);
  image.depth.release();
  EXPECT_EQ(cv::countNonZero(depth_in_metres(image, rays_)), 0);
}

TEST_F(BackgroundViewTest, AGreyImageIsItsOwnBrightness) {
  RgbdImage image = PlaneScene::image(0);
  cv::extractChannel(image.colour, image.colour, 1);
  const BackgroundView view = make_view(image, {}, 4, at_, rays_);
  EXPECT_EQ(cv::norm(view.grey, image.colour, cv::NORM_INF), 0);
  EXPECT_EQ(view.half_grey.size(), cv::Size(80, 60));
}

TEST(Grown, IsADisc) {
  cv::Mat mask(41, 41, CV_8UC1, cv::Scalar(0));
  mask.at<std::uint8_t>(20, 20) = 255;
  const cv::Mat disc = grown(mask, 6);
  EXPECT_EQ(disc.at<std::uint8_t>(20, 26), 255);
  EXPECT_EQ(disc.at<std::uint8_t>(20, 27), 0);
  EXPECT_EQ(disc.at<std::uint8_t>(25, 25), 0) << "not a square";
  EXPECT_EQ(cv::norm(grown(mask, 0), mask, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace stdc
