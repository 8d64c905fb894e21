#include "dense/inpainting/depth_splat.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "dense/inpainting/test_plane.hpp"

namespace stdc {
namespace {

using test::PlaneScene;

class DepthSplatTest : public testing::Test {
 protected:
  BackgroundView view(const RgbdImage& image, const cv::Mat& dynamic = {}) const {
    return make_view(image, dynamic, 2, {0, 0, MapId{0}, PlaneScene::world_from_cam(0)}, rays_);
  }
  /// Into a camera `back` metres behind the one of the view.
  SplatDepth splat(const BackgroundView& view, double back, const cv::Mat& region) const {
    AlignedView aligned;
    aligned.view = &view;
    aligned.view_from_frame = Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, -back));
    return splat_depth(aligned, region, rays_);
  }

  RayTable rays_{PlaneScene::camera()};
  const cv::Mat everywhere_ = cv::Mat(120, 160, CV_8UC1, cv::Scalar(255));
};

TEST_F(DepthSplatTest, CarriesDepthWithoutCracks) {
  const BackgroundView wall = view(PlaneScene::image(0));
  // Half a metre nearer: each pixel of the view covers 1.33 of the frame.
  const SplatDepth nearer = splat(wall, -0.5, everywhere_);
  EXPECT_EQ(cv::countNonZero(nearer.measured), 160 * 120);
  EXPECT_NEAR(cv::mean(nearer.measured)[0], PlaneScene::kWall - 0.5, 1e-3);
  EXPECT_EQ(cv::countNonZero(nearer.guessed), 0);
}

TEST_F(DepthSplatTest, OnlyTheRegionIsFilled) {
  const cv::Rect wanted(100, 10, 20, 30);
  const SplatDepth splats = splat(view(PlaneScene::image(0)), 0, PlaneScene::mask(wanted));
  EXPECT_EQ(cv::countNonZero(splats.measured), wanted.area());
  EXPECT_EQ(cv::countNonZero(splats.measured(wanted)), wanted.area());
}

TEST_F(DepthSplatTest, TheNearestOfTwoSurfacesStays) {
  const cv::Rect box(60, 40, 30, 30);  // it rests: no mask
  const SplatDepth splats = splat(view(PlaneScene::image(0, box)), 0, everywhere_);
  EXPECT_NEAR(splats.measured.at<float>(55, 75), PlaneScene::kMover, 1e-3);
  EXPECT_NEAR(splats.measured.at<float>(20, 20), PlaneScene::kWall, 1e-3);
}

TEST_F(DepthSplatTest, GuessesAreKeptApartAndWhatMovesIsNotCarried) {
  RgbdImage image = PlaneScene::image(0);
  const cv::Rect hole(20, 20, 12, 12), mover(90, 50, 30, 30);
  image.depth(hole) = 0;
  const SplatDepth splats = splat(view(image, PlaneScene::mask(mover)), 0, everywhere_);
  EXPECT_EQ(splats.measured.at<float>(26, 26), 0);
  EXPECT_NEAR(splats.guessed.at<float>(26, 26), PlaneScene::kWall, 0.01);
  EXPECT_EQ(splats.measured.at<float>(65, 105), 0);
  EXPECT_EQ(splats.guessed.at<float>(65, 105), 0);
}

}  // namespace
}  // namespace stdc
