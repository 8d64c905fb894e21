#include "run/run_trajectories.hpp"

#include <gtest/gtest.h>

namespace stdc::app {
namespace {

/// Frames of these maps, one after the other; x is the number of the frame.
std::vector<FramePose> frames_in(const std::vector<int>& maps) {
  std::vector<FramePose> poses;
  for (const int map : maps) {
    const int frame = static_cast<int>(poses.size());
    poses.push_back({frame,
                     0.1 * frame,
                     Pose(Eigen::Quaterniond::Identity(), {1.0 * frame, 0, 0}),
                     {static_cast<std::uint32_t>(map)}});
  }
  return poses;
}

TEST(RunTrajectories, OneMapIsOneTrajectory) {
  const RunTrajectories all = by_map(frames_in({0, 0, 0}), frames_in({0, 0}));
  EXPECT_EQ(all.map, MapId{0});
  EXPECT_EQ(all.frames.size(), 3U);
  EXPECT_EQ(all.keyframes.size(), 2U);
  EXPECT_TRUE(all.others.empty());
}

TEST(RunTrajectories, TheMapThatHoldsMostComesFirst) {
  const RunTrajectories all = by_map(frames_in({0, 0, 3, 3, 3, 1, 0, 3}), frames_in({0, 3, 1, 3}));
  EXPECT_EQ(all.map, MapId{3});
  ASSERT_EQ(all.frames.size(), 4U);
  EXPECT_EQ(all.frames.back().world_from_cam.translation.x(), 7);
  EXPECT_EQ(all.keyframes.size(), 2U);
  ASSERT_EQ(all.others.size(), 2U);
  EXPECT_EQ(all.others.at({0}).size(), 3U);
  EXPECT_EQ(all.others.at({1}).size(), 1U);
}

TEST(RunTrajectories, OfEqualsTheOlder) {
  EXPECT_EQ(by_map(frames_in({2, 1, 2, 1}), {}).map, MapId{1});
  EXPECT_EQ(by_map({}, {}).frames.size(), 0U);
}

}  // namespace
}  // namespace stdc::app
