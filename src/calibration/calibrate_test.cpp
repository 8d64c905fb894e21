#include "calibration/calibrate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/depth_scale.hpp"
#include "calibration/scene_recorder.hpp"
#include "core/error.hpp"
#include "slam/system_tests/test_sequence.hpp"

namespace stdc {
namespace {

using enum CalibrationParameter;
using test::TestSequence;

constexpr double kPeriod = 1.0 / 30;

/// What the recording would be with another camera file, and stamps of depth that say other than they should.
/// @param late    frames by which the depth images are late that go with the colour images
/// @param offset  [s] by which they were taken later than their stamps say
CalibrationScene scene_of_a_desk(const Camera& camera, int late = 0, double offset = 0) {
  const auto& frames = TestSequence::of_a_desk().frames;
  SceneRecorder recorder(camera, Settings());
  for (std::size_t i = 0; i + static_cast<std::size_t>(late) < frames.size(); ++i) {
    RgbdImage image = frames[i].image;
    image.depth = frames[i + static_cast<std::size_t>(late)].image.depth;
    recorder.track(image, late * kPeriod - offset);
  }
  return recorder.finish("test");
}

TEST(Calibrate, FindsThatDepthComesLate) {
  const Camera& camera = TestSequence::of_a_desk().camera;
  const Calibration first =
      calibrate(scene_of_a_desk(camera, 1, kPeriod), calibration_values(camera, 0), {depth_time_offset});
  ASSERT_TRUE(first.estimates[0].seen) << first.estimates[0].sigma;
  EXPECT_NEAR(first.values[0], kPeriod, 0.007) << "+- " << first.estimates[0].sigma;
  // With the right depth for each image.
  const Calibration second =
      calibrate(scene_of_a_desk(camera, 0, kPeriod), first.values, {depth_time_offset});
  EXPECT_NEAR(second.values[0], kPeriod, 0.003) << "+- " << second.estimates[0].sigma;
}

TEST(Calibrate, LeavesWhatIsRight) {
  const Camera& camera = TestSequence::of_a_desk().camera;
  const Calibration found =
      calibrate(scene_of_a_desk(camera), calibration_values(camera, 0), {depth_time_offset, readout_time});
  EXPECT_NEAR(found.values[0], 0, 0.003) << "+- " << found.estimates[0].sigma;
  EXPECT_NEAR(found.values[1], 0, 0.002) << "+- " << found.estimates[1].sigma;
}

TEST(Calibrate, FindsTheFocalLength) {
  const TestSequence& room = TestSequence::of_a_room();
  Camera wrong = room.camera;
  wrong.fx *= 1.02, wrong.fy *= 1.02, wrong.cx += 2;
  SceneRecorder recorder(wrong, Settings());
  for (const auto& frame : room.frames) recorder.track(frame.image, 0);
  const CalibrationScene scene = recorder.finish("test");
  const Calibration found = calibrate(scene, calibration_values(wrong, 0), {focal_length, cx, cy});
  const Camera camera = calibrated_camera(wrong, found.values);
  EXPECT_NEAR(camera.fx / room.camera.fx, 1, 0.006) << "+- " << found.estimates[0].sigma;
  EXPECT_NEAR(camera.fx / room.camera.fx, 1, 3 * found.estimates[0].sigma);
  EXPECT_NEAR(camera.cx, room.camera.cx, 0.7) << "+- " << found.estimates[1].sigma;
}

TEST(Calibrate, AStillCameraTellsNothing) {
  const TestSequence& desk = TestSequence::of_a_desk();
  SceneRecorder recorder(desk.camera, Settings());
  for (int i = 0; i < 10; ++i) {
    RgbdImage image = desk.frames[0].image;
    image.timestamp += i * kPeriod;
    recorder.track(image, 0);
  }
  EXPECT_THROW(recorder.finish("test"), Error);
}

TEST(DepthScale, FollowsFromTheTruthAndFromADistance) {
  std::vector<StampedPose> truth, estimate;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d position(0.01 * i, 0.2 * std::sin(0.1 * i), 0.1);
    truth.push_back({kPeriod * i, Pose(Eigen::Quaterniond::Identity(), position)});
    estimate.push_back({kPeriod * i, Pose(Eigen::Quaterniond::Identity(), 0.97 * position)});
  }
  const auto by_truth = depth_scale_by_truth(estimate, truth);
  ASSERT_TRUE(by_truth);
  EXPECT_NEAR(by_truth->factor, 1 / 0.97, 1e-6);
  const double distance =
      (truth.back().world_from_cam.translation - truth.front().world_from_cam.translation).norm();
  const auto by_distance = depth_scale_by_distance(estimate, distance);
  ASSERT_TRUE(by_distance);
  EXPECT_NEAR(by_distance->factor, 1 / 0.97, 1e-6);
  EXPECT_FALSE(depth_scale_by_distance({estimate.front()}, 1));
}

}  // namespace
}  // namespace stdc
