#include "dense/fusion/depth_window.hpp"

#include <gtest/gtest.h>

#include "dense/fusion/depth_cleaning.hpp"
#include "dense/fusion/rectifier.hpp"
#include "dense/fusion/test_views.hpp"

namespace stdc {
namespace {

using test::dense_camera;

CleanDepth wall(float z) { return {cv::Mat(120, 160, CV_32FC1, cv::Scalar(z)), {}}; }
float centre(const DepthWindow& window) { return window.fused().depth.at<float>(60, 80); }
int frames_at_centre(const DepthWindow& window) {
  return window.fused().support.at<std::uint8_t>(60, 80) & FusedDepth::kCount;
}
Pinhole pinhole() { return pinhole_of(dense_camera()); }

TEST(DepthWindow, FramesThatAgreeAreAveraged) {
  DepthWindow window(pinhole(), wall(2));
  window.add(wall(2.02F), Pose());
  window.add(wall(2.01F), Pose());
  EXPECT_NEAR(centre(window), 2.01F, 1e-4F);
  EXPECT_EQ(frames_at_centre(window), 3);
}

TEST(DepthWindow, DepthIsCarriedByTheMotionOfTheCamera) {
  DepthWindow window(pinhole(), wall(2));
  window.add(wall(1.9F), Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, -0.1)));
  EXPECT_NEAR(centre(window), 2, 1e-4F);
  EXPECT_EQ(frames_at_centre(window), 2);
}

TEST(DepthWindow, WhatIsSeenThroughGoesAndWhatIsBehindTakesItsPlace) {
  CleanDepth first = wall(3);
  first.still(cv::Rect(60, 40, 40, 40)) = 1;  // somebody whom the mask missed
  DepthWindow window(pinhole(), clean_depth(first.still, {}, {}, 0));
  for (int i = 0; i < 6; ++i) window.add(wall(3), Pose());
  EXPECT_NEAR(centre(window), 3, 1e-4F);
  EXPECT_EQ(window.fused().support.at<std::uint8_t>(60, 80) & FusedDepth::kDirect, 0)
      << "the first frame did not see the wall there";
}

TEST(DepthWindow, WhatComesBeforeASurfaceSaysNothing) {
  DepthWindow window(pinhole(), wall(3));
  CleanDepth later = wall(3);
  later.still(cv::Rect(60, 40, 40, 40)) = 1;
  for (int i = 0; i < 6; ++i) window.add(later, Pose());
  EXPECT_NEAR(centre(window), 3, 1e-4F);
  EXPECT_EQ(frames_at_centre(window), 1);
}

TEST(DepthWindow, WhatIsFoundToMoveGoes) {
  CleanDepth first = wall(3), later = wall(3);
  const cv::Rect place(60, 40, 40, 40);
  first.still(place) = 1;  // the mask missed it at first
  later.still(place) = 0;
  later.moving = cv::Mat(120, 160, CV_32FC1, cv::Scalar(0));
  later.moving(place) = 1.01F;
  DepthWindow window(pinhole(), first);
  window.add(later, Pose());
  EXPECT_EQ(window.fused().support.at<std::uint8_t>(60, 80), 0);
  DepthWindow moving(pinhole(), later);
  EXPECT_EQ(moving.fused().support.at<std::uint8_t>(60, 80), FusedDepth::kMoving);
  EXPECT_NEAR(centre(moving), 1.01F, 1e-4F);
}

TEST(DepthCleaning, DynamicPixelsTheirMarginAndStepsGo) {
  cv::Mat depth = wall(2).still;
  depth(cv::Rect(100, 0, 60, 120)) = 3;
  cv::Mat dynamic(120, 160, CV_8UC1, cv::Scalar(0));
  dynamic(cv::Rect(30, 30, 10, 10)) = 255;
  cv::Mat doubtful(120, 160, CV_8UC1, cv::Scalar(0));
  doubtful(cv::Rect(30, 80, 10, 10)) = 255;
  const CleanDepth both = clean_depth(depth, dynamic, doubtful, 5);
  const cv::Mat& clean = both.still;
  EXPECT_EQ(both.moving.at<float>(35, 35), 2);
  EXPECT_EQ(both.moving.at<float>(85, 35), 0) << "it only may move";
  EXPECT_EQ(clean.at<float>(85, 35), 0);
  EXPECT_EQ(clean.at<float>(35, 35), 0);
  EXPECT_EQ(clean.at<float>(35, 44), 0) << "margin";
  EXPECT_EQ(clean.at<float>(35, 45), 2);
  EXPECT_EQ(clean.at<float>(60, 99), 0) << "beside a step";
  EXPECT_EQ(clean.at<float>(60, 100), 0);
  EXPECT_EQ(clean.at<float>(60, 101), 3);
}

TEST(Rectifier, ADistortedCameraBecomesAPinholeThatSeesTheSame) {
  Camera camera = dense_camera();
  camera.k1 = 0.25, camera.k2 = -0.6, camera.k3 = 0.5;
  const Rectifier rectifier(camera);
  const Pinhole& pinhole = rectifier.pinhole();
  cv::Mat depth(120, 160, CV_16UC1);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) depth.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(5000 + 10 * x);
  }
  const cv::Mat z = rectifier.depth(depth, 10);
  for (const cv::Point pixel : {cv::Point(20, 20), cv::Point(80, 60), cv::Point(140, 100)}) {
    const Eigen::Vector2d ideal = camera.undistort({pixel.x, pixel.y});
    const int u =
        static_cast<int>(std::lround((ideal.x() - camera.cx) / camera.fx * pinhole.fx + pinhole.cx));
    const int v =
        static_cast<int>(std::lround((ideal.y() - camera.cy) / camera.fy * pinhole.fy + pinhole.cy));
    EXPECT_NEAR(z.at<float>(v, u), 1 + 0.002F * static_cast<float>(pixel.x), 0.0041F);
  }
  EXPECT_EQ(cv::countNonZero(rectifier.depth(cv::Mat(), 10)), 0);
  EXPECT_EQ(cv::countNonZero(rectifier.depth(depth, 1.1F) > 1.1F), 0) << "beyond the largest depth";
}

}  // namespace
}  // namespace stdc
