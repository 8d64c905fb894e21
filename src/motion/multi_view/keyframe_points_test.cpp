#include "motion/multi_view/keyframe_points.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

KeyframePoints keyframe(int frame, double x) {
  KeyframePoints points;
  points.frame = frame;
  points.map = MapId{0};
  points.keyframe_from_world = Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-x, 0, 0));
  for (int i = -20; i <= 20; ++i) {
    for (int k = 0; k < 8; ++k) points.points.emplace_back(0.05F * static_cast<float>(i), 0, 2);
  }
  return points;
}

TEST(KeyframeStore, ChoosesThoseThatOverlapMost) {
  const GridGeometry geometry{Camera()};
  KeyframeStore store(10);
  store.add(keyframe(1, 3));
  store.add(keyframe(2, 0.1));
  store.add(keyframe(3, 0.8));
  const auto chosen = store.overlapping(geometry, Pose(), MapId{0}, 2);
  ASSERT_EQ(chosen.size(), 2U);
  EXPECT_EQ(chosen[0]->frame, 2);
  EXPECT_EQ(chosen[1]->frame, 3);
  EXPECT_TRUE(store.overlapping(geometry, Pose(), MapId{1}, 2).empty());
}

TEST(KeyframeStore, HoldsABoundedNumber) {
  KeyframeStore store(2);
  for (int i = 1; i <= 3; ++i) store.add(keyframe(i, 0));
  EXPECT_FALSE(store.has(1));
  EXPECT_TRUE(store.has(2) && store.has(3));
}

}  // namespace
}  // namespace stdc
