#include "simulation/sequence/camera_path.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace stdc::simulation {
namespace {

constexpr MotionKind kMotions[] = {MotionKind::desk, MotionKind::room_loop,  MotionKind::watch,
                                   MotionKind::xyz,  MotionKind::halfsphere, MotionKind::rpy,
                                   MotionKind::held};

TEST(CameraPath, StartsFromRestAndMovesLikeAHand) {
  for (const MotionKind kind : kMotions) {
    const CameraPath motion(kind, 1);
    const auto speeds = [&](double t) {
      constexpr double kSpan = 1.0 / 60;
      const Pose step = motion.world_from_cam(t).inverse() * motion.world_from_cam(t + kSpan);
      return std::pair{step.translation.norm() / kSpan,
                       rotation_log(step.rotation).norm() / kSpan * 180 / std::numbers::pi};
    };
    EXPECT_LT(speeds(0).first, 0.02) << static_cast<int>(kind);
    EXPECT_LT(speeds(0).second, 2) << static_cast<int>(kind);
    double mean_speed = 0, mean_rotation_rate = 0, max_speed = 0, max_rotation_rate = 0;
    constexpr int kSamples = 560;
    for (int i = 0; i < kSamples; ++i) {
      const auto [speed, rotation_rate] = speeds(2 + 0.05 * i);
      mean_speed += speed / kSamples;
      mean_rotation_rate += rotation_rate / kSamples;
      max_speed = std::max(max_speed, speed);
      max_rotation_rate = std::max(max_rotation_rate, rotation_rate);
    }
    RecordProperty("speed", std::to_string(mean_speed));
    const bool held = kind == MotionKind::held, rotates = kind == MotionKind::rpy;
    EXPECT_GT(mean_speed, held ? 0.005 : (rotates ? 0.03 : 0.1)) << static_cast<int>(kind);
    EXPECT_LT(mean_speed, held ? 0.05 : 0.5) << static_cast<int>(kind);
    EXPECT_LT(max_speed, 1.0) << static_cast<int>(kind);
    EXPECT_GT(mean_rotation_rate, held ? 0.3 : 3) << static_cast<int>(kind);
    EXPECT_LT(max_rotation_rate, 75) << static_cast<int>(kind);
  }
}

TEST(CameraPath, TheRoomLoopEndsWhereItBegan) {
  const CameraPath motion(MotionKind::room_loop, 3);
  const Pose start = motion.world_from_cam(0),
             end = motion.world_from_cam(CameraPath::kLoopSeconds - 1.0 / 30);
  EXPECT_LT((start.translation - end.translation).norm(), 0.01);
  EXPECT_LT(start.rotation.angularDistance(end.rotation), 0.01);
  double length = 0;
  for (double t = 0; t < CameraPath::kLoopSeconds; t += 0.1) {
    length += (motion.world_from_cam(t + 0.1).translation - motion.world_from_cam(t).translation).norm();
  }
  EXPECT_GT(length, 10);
}

}  // namespace
}  // namespace stdc::simulation
