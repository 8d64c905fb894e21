#include "input/ground_truth.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

TEST(GroundTruth, RowsWithoutAPoseAreLeftOutAndCounted) {
  const GroundTruth truth = parse_ground_truth(
      "timestamp tx ty tz qx qy qz qw\n# comment\n"
      "3 1 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n1.5 nan nan nan nan nan nan nan\n1.6 inf 0 0 0 0 0 1\n"
      "1.7 0 0 0 0 0 0 0\n2 0.5 0 0 0 0 0 1\n2 0.7 0 0 0 0 0 1\n2.5 0 0\n");
  EXPECT_EQ(truth.rows, 9);
  EXPECT_EQ(truth.malformed, 2);
  EXPECT_EQ(truth.without_pose, 3);
  EXPECT_EQ(truth.repeated, 1);
  ASSERT_EQ(truth.poses.size(), 3U);
  EXPECT_EQ(truth.poses[1].world_from_cam.translation.x(), 0.5);
  EXPECT_EQ(truth.note(), "6 of 9 rows are left out (3 without a pose, 2 malformed, 1 with a repeated time)");
}

TEST(GroundTruth, MayHaveNoPoseAtAll) {
  EXPECT_TRUE(parse_ground_truth("").poses.empty());
  EXPECT_EQ(parse_ground_truth("1 0 0 0 0 0 0 1\n").note(), "");
}

}  // namespace
}  // namespace stdc
