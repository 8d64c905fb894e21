#include "input/trajectory_formats.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace stdc {
namespace {

TEST(TrajectoryFormats, AreToldByTheirFirstRow) {
  const TrajectoryFile tum = parse_any_trajectory("# evo\n1.0e+00 2.5e-01 0 0 0 0 0 1\n", "t");
  EXPECT_EQ(tum.format, TrajectoryFormat::tum);
  EXPECT_EQ(tum.content.poses.at(0).world_from_cam.translation.x(), 0.25);
  const TrajectoryFile kitti =
      parse_any_trajectory("0 -1 0 1 1 0 0 2 0 0 1 3\n1 0 0 0 0 1 0 0 0 0 1 0\n", "k");
  EXPECT_EQ(kitti.format, TrajectoryFormat::kitti);
  ASSERT_EQ(kitti.content.poses.size(), 2U);
  EXPECT_EQ(kitti.content.poses[0].world_from_cam.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE((kitti.content.poses[0].world_from_cam.rotation * Eigen::Vector3d::UnitX())
                  .isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_EQ(kitti.content.poses[1].timestamp, 0.1);
  const TrajectoryFile euroc = parse_any_trajectory(
      "#ns,p,q\n1403636580838555648, 4.6,-1.7,0.9, 0.5,0.5,-0.5,0.5, 1,2\nbad,row\n", "e");
  EXPECT_EQ(euroc.format, TrajectoryFormat::euroc);
  ASSERT_EQ(euroc.content.poses.size(), 1U);
  EXPECT_NEAR(euroc.content.poses[0].timestamp, 1403636580.838556, 1e-6);
  EXPECT_EQ(euroc.content.poses[0].world_from_cam.rotation.y(), -0.5);
  EXPECT_EQ(euroc.content.malformed, 1);
}

TEST(TrajectoryFormats, EveryRowOfKittiCounts) {
  const std::string good = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  EXPECT_THROW(parse_any_trajectory(good + "1 0 0 0 0 1 0 0 0 0 1\n", "k"), Error);
  EXPECT_THROW(parse_any_trajectory(good + "1 0 0 nan 0 1 0 0 0 0 1 0\n", "k"), Error);
  EXPECT_THROW(parse_any_trajectory("-1 0 0 0 0 1 0 0 0 0 1 0\n", "k"), Error) << "a mirror is no rotation";
}

TEST(TrajectoryFormats, AnEmptyFileHasNoPoses) {
  EXPECT_TRUE(parse_any_trajectory("", "t").content.poses.empty());
}

}  // namespace
}  // namespace stdc
