#include "dense/inpainting/view_alignment.hpp"

#include <gtest/gtest.h>

#include "dense/inpainting/test_plane.hpp"

namespace stdc {
namespace {

using test::PlaneScene;

class ViewAlignmentTest : public testing::Test {
 protected:
  /// A view at `x`, which is believed to be at `believed`.
  BackgroundView view(double x, double believed, double exposure = 1, cv::Rect mover = {}) const {
    return make_view(PlaneScene::image(x, mover, exposure), PlaneScene::mask(mover), 2,
                     {0, 0, MapId{0}, PlaneScene::world_from_cam(believed)}, rays_);
  }

  RayTable rays_{PlaneScene::camera()};
  BackgroundView frame_ = view(0, 0);
  AlignmentTarget target_{frame_, rays_};
};

TEST_F(ViewAlignmentTest, AWrongPoseIsCorrected) {
  const BackgroundView other = view(0.1, 0.12);  // 1.5 px off
  const AlignedView as_known = target_.align(other, false), aligned = target_.align(other, true);
  EXPECT_NEAR(as_known.view_from_frame.translation.x(), -0.12, 1e-9);
  EXPECT_NEAR(aligned.view_from_frame.translation.x(), -0.1, 0.003);
  EXPECT_LT(rotation_log(aligned.view_from_frame.rotation).norm(), 0.002);
  EXPECT_LT(aligned.residual, 0.5 * as_known.residual);
}

TEST_F(ViewAlignmentTest, ARightPoseStaysAndTheExposureIsFound) {
  const AlignedView aligned = target_.align(view(0.1, 0.1, 0.8), true);
  EXPECT_NEAR(aligned.view_from_frame.translation.x(), -0.1, 0.002);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(aligned.gain[c], 1.25, 0.02) << c;
}

TEST_F(ViewAlignmentTest, WhatTheViewSawMoveDoesNotCount) {
  const AlignedView aligned = target_.align(view(0.1, 0.11, 1, {30, 20, 60, 60}), true);
  EXPECT_NEAR(aligned.view_from_frame.translation.x(), -0.1, 0.003);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(aligned.gain[c], 1, 0.02) << c;
}

TEST_F(ViewAlignmentTest, WhereLittleIsSharedTheKnownPoseStays) {
  const BackgroundView far = view(1.95, 1.97);  // the images share some columns
  const AlignedView aligned = target_.align(far, true);
  EXPECT_NEAR(aligned.view_from_frame.translation.x(), -1.97, 1e-9);
  EXPECT_EQ(aligned.gain, cv::Vec3f(1, 1, 1));
}

}  // namespace
}  // namespace stdc
