#include "input/pose_row.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

using Kind = PoseRow::Kind;

TEST(PoseRow, HoldsTimePositionAndRotation) {
  const PoseRow row = parse_pose_row("1.5e18 1\t2 3 0.6 0 0 0.8");
  ASSERT_EQ(row.kind, Kind::pose);
  EXPECT_EQ(row.problem, "");
  EXPECT_EQ(row.pose.timestamp, 1.5e18) << "any unit will do";
  EXPECT_EQ(row.pose.world_from_cam.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(row.pose.world_from_cam.rotation.x(), 0.6, 1e-12);
}

TEST(PoseRow, SaysWhyThereIsNone) {
  const auto expect = [](const char* line, Kind kind, const char* problem) {
    const PoseRow row = parse_pose_row(line);
    EXPECT_EQ(row.kind, kind) << line;
    EXPECT_EQ(row.problem, problem) << line;
  };
  expect("1 2 3", Kind::malformed, "has 3 values instead of 8");
  expect("1 nan x 0 0 0 0 1", Kind::malformed, "'x' is not a finite number");
  expect("t 0 0 0 0 0 0 1", Kind::malformed, "the timestamp 't' is not a finite number");
  expect("1 0 inf 0 0 0 0 1", Kind::without_pose, "'inf' is not a finite number");
  expect("nan 0 0 0 0 0 0 1", Kind::without_pose, "the timestamp 'nan' is not a finite number");
  expect("1 0 0 0 0 0 0 0", Kind::without_pose, "the quaternion has length 0 instead of 1");
  expect("1 0 0 0 1 1 0 0", Kind::without_pose, "the quaternion has length 1.41 instead of 1");
}

}  // namespace
}  // namespace stdc
