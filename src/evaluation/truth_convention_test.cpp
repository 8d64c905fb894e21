#include "evaluation/truth_convention.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"

namespace stdc {
namespace {

/// A camera that goes up and around and turns, at 30 Hz.
Trajectory truth() {
  Trajectory trajectory;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.03 * i;
    Vector6d twist;
    twist << std::sin(t), 0.7 * std::cos(1.3 * t), 0.2 * t, 0.6 * std::sin(0.9 * t), 0.4 * t,
        0.3 * std::cos(t);
    trajectory.push_back({1000 + i / 30.0, Pose::exp(twist)});
  }
  return trajectory;
}

Trajectory estimate() {
  Trajectory trajectory = truth();
  Random random(5);
  for (StampedPose& pose : trajectory) {
    pose.world_from_cam.translation += Eigen::Vector3d(
        random.uniform(-0.005, 0.005), random.uniform(-0.005, 0.005), random.uniform(-0.005, 0.005));
  }
  return trajectory;
}

TEST(TruthConvention, TheUsualOneIsLeftAlone) {
  EXPECT_TRUE(recognise_convention(truth(), estimate()).usual());
  EXPECT_EQ(TruthConvention().note(), "");
  EXPECT_TRUE(recognise_convention({}, estimate()).usual());
}

TEST(TruthConvention, UnitsOfTimeAreRecognised) {
  for (const auto& [factor, name] :
       {std::pair{1e3, "milliseconds"}, {1e6, "microseconds"}, {1e9, "nanoseconds"}}) {
    Trajectory recorded = truth();
    for (StampedPose& pose : recorded) pose.timestamp *= factor;
    const TruthConvention convention = recognise_convention(recorded, estimate());
    EXPECT_NEAR(convention.seconds_per_unit * factor, 1, 1e-9) << name;
    EXPECT_EQ(convention.note(), std::string("its times are taken for ") + name);
    EXPECT_NEAR(apply_convention(recorded, convention).back().timestamp, truth().back().timestamp, 1e-6);
  }
  Trajectory elsewhere = truth();
  for (StampedPose& pose : elsewhere) pose.timestamp += 500;
  EXPECT_TRUE(recognise_convention(elsewhere, estimate()).usual()) << "another time is not another unit";
}

TEST(TruthConvention, WorldToCameraIsRecognised) {
  Trajectory recorded = truth();
  for (StampedPose& pose : recorded) pose.world_from_cam = pose.world_from_cam.inverse();
  const TruthConvention convention = recognise_convention(recorded, estimate());
  EXPECT_EQ(convention, (TruthConvention{1, true, false}));
  EXPECT_EQ(convention.note(), "its poses are taken for world-to-camera");
}

TEST(TruthConvention, LeftHandedAxesAreRecognised) {
  Trajectory recorded = truth();
  for (StampedPose& pose : recorded) {  // y points the other way
    Eigen::Quaterniond& q = pose.world_from_cam.rotation;
    q = Eigen::Quaterniond(q.w(), -q.x(), q.y(), -q.z());
    pose.world_from_cam.translation.y() *= -1;
  }
  const TruthConvention convention = recognise_convention(recorded, estimate());
  EXPECT_EQ(convention, (TruthConvention{1, false, true}));
  EXPECT_EQ(convention.note(), "its poses are taken for left-handed");
}

TEST(TruthConvention, ABadEstimateIsNoReason) {
  Trajectory wrong = estimate();
  Random random(7);
  for (StampedPose& pose : wrong)
    pose.world_from_cam.translation +=
        Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  EXPECT_TRUE(recognise_convention(truth(), wrong).usual());
}

}  // namespace
}  // namespace stdc
