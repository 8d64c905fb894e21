#include "motion/map_motion.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "motion/test_room.hpp"
#include "motion/test_wall_scene.hpp"

namespace stdc {
namespace {

using test::overlap;
using test::Panel;
using test::WallRun;
using test::WallScene;

/// A detector, and a run that feeds it. Views stay where they were made: the map does not move here.
struct Fixture {
  MapMotion motion;
  WallRun run;

  explicit Fixture(const MotionSettings& settings = {}) : motion(WallScene().camera, settings), run(motion) {}
  double dynamic_share() const { return cv::countNonZero(motion.mask()) / (320.0 * 240.0); }
  double overlap_with_panels(const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) const {
    return overlap(motion.mask(), run.scene.panel_mask(centre));
  }
  void look_at_empty_wall(int frames) {
    for (int i = 0; i < frames; ++i) run.see();
  }
};

Panel board(double left) { return {left, left + 0.7, -0.5, 0.5, 1.5}; }

TEST(MapMotion, NothingMovesInAStillScene) {
  Fixture f;
  f.run.scene.panels = {{-0.8, -0.2, -0.4, 0.4, 2}, {0.2, 0.5, -0.1, 0.6, 1.2}};
  for (int i = 0; i < 60; ++i) {
    f.run.see({0.01 * i, 0.003 * i, 0.004 * i});
    EXPECT_LT(f.dynamic_share(), 0.002) << i;
  }
}

TEST(MapMotion, FindsABoardThatSlidesThroughTheView) {
  Fixture f;
  f.look_at_empty_wall(10);
  for (int i = 0; i < 40; ++i) {
    f.run.scene.panels = {board(-1.6 + 0.03 * i)};
    f.run.see();
    if (i >= 10) {
      EXPECT_GT(f.overlap_with_panels(), 0.8) << i;
    }
  }
  f.run.scene.panels.clear();
  f.look_at_empty_wall(5);
  EXPECT_LT(f.dynamic_share(), 0.01) << "it has gone";
}

TEST(MapMotion, FindsABoardWhileTheCameraMovesToo) {
  Fixture f;
  f.look_at_empty_wall(10);
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector3d centre(0.01 * i, 0, 0.005 * i);
    f.run.scene.panels = {board(-1.2 + 0.03 * i)};
    f.run.see(centre);
    if (i >= 10) {
      EXPECT_GT(f.overlap_with_panels(centre), 0.75) << i;
    }
  }
}

TEST(MapMotion, WhatCoversMostOfTheViewIsNotTheSceneForIt) {
  Fixture f;
  f.look_at_empty_wall(10);
  for (int i = 0; i < 30; ++i) {
    f.run.scene.panels = {{-2.5 + 0.05 * i, -0.4 + 0.05 * i, -1, 1, 1.4}};
    f.run.see();
  }
  EXPECT_GT(cv::countNonZero(f.run.scene.panel_mask({})) / (320.0 * 240.0), 0.6);
  EXPECT_GT(f.overlap_with_panels(), 0.9);
}

TEST(MapMotion, FindsWhatWalksAway) {
  Fixture f;
  f.run.scene.panels = {{-0.3, 0.3, -0.4, 0.4, 1.2}};
  for (int i = 0; i < 15; ++i) f.run.see();
  for (int i = 0; i < 25; ++i) {
    f.run.scene.panels[0].z = 1.2 + 0.03 * i;
    f.run.see();
  }
  EXPECT_GT(f.overlap_with_panels(), 0.7);
}

TEST(MapMotion, WhatWasPutDownBelongsToTheSceneAfterItsTime) {
  MotionSettings settings;
  settings.rest_time = 1;
  Fixture f(settings);
  f.look_at_empty_wall(10);
  f.run.scene.panels = {board(-0.3)};
  for (int i = 0; i < 20; ++i) f.run.see();
  EXPECT_GT(f.overlap_with_panels(), 0.8) << "on probation";
  for (int i = 0; i < 50; ++i) f.run.see();
  EXPECT_LT(f.dynamic_share(), 0.01) << "it has rested";
  f.run.scene.panels.clear();
  f.look_at_empty_wall(20);
  EXPECT_LT(f.dynamic_share(), 0.01) << "taken away again, it leaves nothing behind";
}

TEST(MapMotion, ABoardThatSlidesInItsOwnPlaneDoesNotRest) {
  MotionSettings settings;
  settings.rest_time = 1;
  Fixture f(settings);
  f.look_at_empty_wall(10);
  for (int i = 0; i < 90; ++i) {
    f.run.scene.panels = {{-2.0 + 0.02 * i, 0.6 + 0.02 * i, -1, 1, 1.4, 1, 0.02 * i}};
    f.run.see();
  }
  EXPECT_GT(f.overlap_with_panels(), 0.85);
}

// In the first frames the camera moves to the side and a board comes in there: of its front alone views know
// that it stands where nothing stood, the rest is where nobody has looked before.
TEST(MapMotion, WhatComesInFromWhereNobodyHasLookedMovesAsAWhole) {
  Fixture f;
  f.look_at_empty_wall(3);
  for (int i = 0; i < 25; ++i) {
    const Eigen::Vector3d centre(-0.04 * i, 0, 0);
    f.run.scene.panels = {{-4, -0.9 + 0.02 * i, -1, 1, 1.4}};
    f.run.see(centre);
    if (i >= 6) {
      EXPECT_GT(f.overlap_with_panels(centre), 0.85) << i;
    }
  }
}

// A segmenter calls something that is joined to the wall a person in the very first frames, when nobody knows
// the wall.
TEST(MapMotion, WhatASegmentersPersonTouchesDoesNotMoveWithIt) {
  Fixture f;
  cv::Mat person = cv::Mat::zeros(240, 320, CV_8UC1);
  person(cv::Rect(120, 60, 70, 120)) = 255;
  f.run.segmented = person;
  for (int i = 0; i < 10; ++i) {
    // Sideways, so that ever more of the wall has not been seen before.
    f.run.see({0.06 * i, 0, 0});
    EXPECT_LT(f.dynamic_share(), 0.15) << i;
  }
  f.run.segmented.release();
  for (int i = 10; i < 40; ++i) f.run.see({0.6, 0, 0});
  EXPECT_LT(f.dynamic_share(), 0.01) << "the wall has become known";
}

TEST(MapMotion, WhatPausesDoesNotMoveNowButStaysMasked) {
  Fixture f;
  f.look_at_empty_wall(10);
  for (int i = 0; i < 20; ++i) {
    f.run.scene.panels = {board(-1.1 + 0.04 * i)};
    f.run.see();
  }
  const auto moving_now = [&] {
    return cv::countNonZero(f.motion.moving_now(f.motion.mask())) / (320.0 * 240.0);
  };
  EXPECT_GT(moving_now(), 0.05);
  for (int i = 0; i < 20; ++i) f.run.see();
  EXPECT_GT(f.overlap_with_panels(), 0.8) << "it may go on at any time";
  EXPECT_LT(moving_now(), 0.005);
  for (int i = 0; i < 4; ++i) {
    f.run.scene.panels = {board(-0.34 + 0.04 * i)};
    f.run.see();
  }
  EXPECT_GT(moving_now(), 0.05) << "it goes on";
}

TEST(MapMotion, BesideAHoleInTheDepthNothingIsFresh) {
  Fixture f;
  // A black screen before the wall: the sensor sees nothing of it, and later a rim that is a little wider.
  f.run.scene.panels = {{-0.5, 0.5, -0.4, 0.4, 1.5}};
  const cv::Mat screen = f.run.scene.panel_mask({});
  for (int i = 0; i < 40; ++i) {
    if (i == 10) f.run.scene.panels = {{-0.517, 0.517, -0.417, 0.417, 1.5}};
    f.run.see({}, screen);
    EXPECT_LT(f.dynamic_share(), 0.002) << i;
  }
}

TEST(MapMotion, SaturatedPixelsDoNotSpeakAgainstAPose) {
  Fixture f;
  for (int i = 0; i < 10; ++i) f.run.see();
  cv::Mat grey, depth, exposed;
  f.run.scene.draw({0, 0, 0}, grey, depth);
  grey.convertTo(exposed, CV_8UC1, 1.9);  // the brighter half is white now
  SmallFrame small;
  shrink_frame(exposed, depth, f.run.scene.camera.depth_units_per_metre, small);
  const auto agreement = f.motion.agreement(Pose(), {0}, small, depth, {});
  ASSERT_TRUE(agreement);
  EXPECT_GT(agreement->looks, 0.8);
}

TEST(MapMotion, APoseThatIsFarOffDoesNotAgree) {
  Fixture f;
  f.run.scene.panels = {{-0.9, -0.3, -0.5, 0.5, 1.6}, {0.1, 0.6, -0.5, 0.2, 1.2}};
  for (int i = 0; i < 10; ++i) f.run.see();
  cv::Mat grey, depth;
  f.run.scene.draw({0, 0, 0}, grey, depth);
  SmallFrame small;
  shrink_frame(grey, depth, f.run.scene.camera.depth_units_per_metre, small);
  const auto right = f.motion.agreement(Pose(), {0}, small, depth, {});
  ASSERT_TRUE(right);
  EXPECT_GT(right->depth, 0.97);
  EXPECT_GT(right->looks, 0.95);
  const Pose nearer(Eigen::Quaterniond::Identity(), {0, 0, -0.6});
  const auto wrong = f.motion.agreement(nearer, {0}, small, depth, {});
  ASSERT_TRUE(wrong);
  EXPECT_LT(wrong->depth, 0.3) << "sixty centimetres nearer to the wall";
  const Pose beside(Eigen::Quaterniond::Identity(), {0.2, 0, 0});
  const auto sideways = f.motion.agreement(beside, {0}, small, depth, {});
  ASSERT_TRUE(sideways);
  EXPECT_LT(sideways->looks, 0.8) << "along the wall depth tells little, but it looks otherwise";
  EXPECT_FALSE(f.motion.agreement(Pose(), {1}, small, depth, {})) << "another map";
}

TEST(MapMotion, TellsWhichLandmarksHaveGone) {
  Fixture f;
  f.run.scene.panels = {board(-0.3)};
  f.run.see();
  MotionFrame frame;
  cv::Mat grey;
  f.run.scene.panels.clear();
  f.run.scene.draw({0, 0, 0}, frame.grey, frame.depth);
  frame.number = 1;
  frame.timestamp = 0.1;
  frame.motion = CameraMotion(f.run.scene.camera, Vector6d::Zero());
  frame.cam_from_world = Pose();
  frame.trusted = true;
  frame.reference = {0};
  frame.map = {0};
  frame.missing = {{{7}, {0, 0, 1.5}}, {{8}, {0.5, 0.2, 3}}, {{9}, {0, 0, 3.5}}};
  SmallFrame small;
  shrink_frame(frame.grey, frame.depth, f.run.scene.camera.depth_units_per_metre, small);
  const std::vector<LandmarkId> gone = f.motion.observe(frame, small, {});
  ASSERT_EQ(gone.size(), 1U) << "on the wall or behind it they may be hidden or missed";
  EXPECT_EQ(gone[0], LandmarkId{7});
}

TEST(MapMotion, LivesWithoutDepth) {
  Fixture f;
  for (int i = 0; i < 3; ++i) f.run.see();
  MotionFrame frame;
  cv::Mat depth;
  f.run.scene.draw({0, 0, 0}, frame.grey, depth);
  frame.depth = cv::Mat(depth.size(), CV_16UC1, cv::Scalar(0));
  frame.number = 3;
  frame.timestamp = 0.1;
  frame.motion = CameraMotion(f.run.scene.camera, Vector6d::Zero());
  SmallFrame small;
  shrink_frame(frame.grey, frame.depth, f.run.scene.camera.depth_units_per_metre, small);
  f.motion.observe(frame, small, {});
  EXPECT_EQ(cv::countNonZero(f.motion.mask()), 0);
  EXPECT_FALSE(f.motion.agreement(Pose(), {0}, small, frame.depth, {}));
}

TEST(MapMotion, KeepsABoundedNumberOfViews) {
  MotionSettings settings;
  settings.max_views = 5;
  MapMotion motion(WallScene().camera, settings);
  WallRun run(motion);
  for (int i = 0; i < 100; ++i) run.see({0.15 * i, 0, 0});
  EXPECT_LE(motion.scene().views().size(), 5U);
}

TEST(MapMotion, SameFramesSameBytes) {
  cv::Mat masks[2];
  for (cv::Mat& mask : masks) {
    Fixture f;
    f.look_at_empty_wall(5);
    for (int i = 0; i < 15; ++i) {
      f.run.scene.panels = {board(-1 + 0.04 * i)};
      f.run.see({0.01 * i, 0, 0});
    }
    mask = f.motion.mask();
  }
  EXPECT_EQ(cv::countNonZero(masks[0] != masks[1]), 0);
}

}  // namespace
}  // namespace stdc
