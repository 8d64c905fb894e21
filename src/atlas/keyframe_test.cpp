#include "atlas/keyframe.hpp"

#include <gtest/gtest.h>

#include "atlas/test_scene.hpp"

namespace stdc {
namespace {

Camera rolling_camera() {
  Camera camera;
  camera.readout_time = 0.03;
  return camera;
}

Vector6d brisk_twist() {
  Vector6d twist;
  twist << 0.3, -0.2, 0.25, 0.5, -0.8, 0.4;
  return twist;
}

TEST(Keyframe, MeasureTakesTheRollingShutterOut) {
  const Camera camera = rolling_camera();
  const CameraMotion motion(camera, brisk_twist());
  Random random(3);
  double max_shift = 0;
  for (int i = 0; i < 200; ++i) {
    const double z = random.uniform(0.7, 4.0);
    const Eigen::Vector2d truth(random.uniform(40, 600), random.uniform(40, 440));
    const Eigen::Vector3d at_middle = camera.unproject(truth, z);
    const Eigen::Vector2f seen = motion.project(camera, at_middle).cast<float>();
    const auto z_seen = static_cast<float>(motion.later(at_middle, motion.row_time(seen.y())).z());
    const Measurement m = measure(camera, motion, seen, z_seen, z_seen, 1.44F);
    EXPECT_LT((m.pixel.cast<double>() - truth).norm(), 0.15);
    EXPECT_NEAR(m.depth, z, 1e-3 * z);
    EXPECT_EQ(m.seen, seen);
    EXPECT_EQ(m.scale, 1.44F);
    max_shift = std::max(max_shift, (seen.cast<double>() - truth).norm());
  }
  EXPECT_GT(max_shift, 5) << "there was something to take out";
}

TEST(Keyframe, TheMiddleRowIsWhereItIsSeen) {
  const Camera camera = rolling_camera();
  const CameraMotion motion(camera, brisk_twist());
  const Eigen::Vector2f seen(100, 239.5F);
  EXPECT_LT((measure(camera, motion, seen, 2, 2, 1).pixel - seen).norm(), 1e-4);
}

TEST(Keyframe, WithoutReadoutTimeNothingIsTakenOut) {
  const Camera camera;
  const CameraMotion motion(camera, brisk_twist());
  const Eigen::Vector2f seen(123.25F, 17.5F);
  const Measurement m = measure(camera, motion, seen, 2, 2.5F, 1.2F);
  EXPECT_EQ(m.pixel, seen);
  EXPECT_EQ(m.depth, 2.5F);
}

TEST(Keyframe, AMissingDepthStaysMissingButThePixelIsMended) {
  const Camera camera = rolling_camera();
  const CameraMotion motion(camera, brisk_twist());
  const Eigen::Vector2f seen(300, 30);
  const Measurement without = measure(camera, motion, seen, 2, 0, 1),
                    with = measure(camera, motion, seen, 2, 2, 1);
  EXPECT_EQ(without.depth, 0);
  EXPECT_EQ(without.pixel, with.pixel);
  EXPECT_GT((without.pixel - seen).norm(), 1);
  EXPECT_EQ(measure(camera, motion, seen, 0, 0, 1).pixel, seen) << "no distance, no shift";
}

TEST(Keyframe, APointThatWasBehindStaysWhereItIsSeen) {
  const Camera camera = rolling_camera();
  Vector6d twist = Vector6d::Zero();
  twist[2] = 100;  // [m/s]: in 15 ms by more than its distance
  const Eigen::Vector2f seen(300, 479);
  EXPECT_EQ(measure(camera, CameraMotion(camera, twist), seen, 0.5F, 0.5F, 1).pixel, seen);
}

TEST(Keyframe, KeypointsWithoutDepthAreTakenToBeAsFarAsMost) {
  test::Scene scene(150);
  scene.camera = rolling_camera();
  test::ViewOptions options;
  options.twist = brisk_twist();
  const test::View view = scene.look(Pose(), options);
  const auto measurements = measure_keypoints(scene.camera, view.motion, *view.features);
  ASSERT_EQ(static_cast<int>(measurements.size()), view.features->size());
  for (int i = 0; i < view.features->size(); ++i) {
    const Eigen::Vector3d truth = scene.points[view.points[i]].position;
    EXPECT_LT((measurements[i].pixel.cast<double>() - scene.camera.project(truth)).norm(), 0.15);
    EXPECT_EQ(measurements[i].scale, view.features->scale_of(i));
  }
  options.depth = false;
  const test::View blind = scene.look(Pose(), options);
  EXPECT_EQ(blind.features->usual_depth(), 1);
  const auto guessed = measure_keypoints(scene.camera, blind.motion, *blind.features);
  const Measurement expected =
      measure(scene.camera, blind.motion, blind.features->pixel(0), 1, 0, blind.features->scale_of(0));
  EXPECT_EQ(guessed[0].pixel, expected.pixel);
  EXPECT_EQ(guessed[0].depth, 0);
}

TEST(Keyframe, MeasuringAgainKeepsWhatWasAligned) {
  test::Scene scene(60);
  scene.camera = rolling_camera();
  test::ViewOptions options;
  options.twist = brisk_twist();
  const test::View view = scene.look(Pose(), options);
  auto measurements = measure_keypoints(scene.camera, view.motion, *view.features);
  measurements[5].seen += Eigen::Vector2f(0.5F, -0.25F);
  measurements[5].scale = 0.5F;
  const Eigen::Vector2f aligned = measurements[5].seen;
  measure_again(scene.camera, CameraMotion(scene.camera, Vector6d::Zero()), *view.features, measurements);
  EXPECT_EQ(measurements[5].seen, aligned);
  EXPECT_LT((measurements[5].pixel - aligned).norm(), 1e-3) << "at rest";
  EXPECT_EQ(measurements[5].scale, 0.5F);
  EXPECT_NEAR(measurements[5].depth, view.features->depth(5), 1e-5);
}

}  // namespace
}  // namespace stdc
