// What may be asked of Slam while it runs: it answers, and nothing else changes.
#include <gtest/gtest.h>

#include "slam/slam.hpp"
#include "slam/system_tests/test_sequence.hpp"
#include "slam/system_tests/test_walk.hpp"

namespace stdc {
namespace {

using test::same_bytes;
using test::TestSequence;

Settings getter_settings() {
  Settings settings;
  settings.features.keypoints = 500;
  return settings;
}

/// What a run gives: all poses as they were told, the trajectory in the end, and how often mapping reported.
struct Answers {
  std::vector<FramePose> told, trajectory;
  int mapped = 0;
};

Answers run_asking(bool ask) {
  const TestSequence& sequence = TestSequence::of_a_desk();
  Slam slam(sequence.camera, getter_settings());
  Answers result;
  for (int i = 0; i < 80; ++i) {
    const TrackingResult tracked = slam.track(sequence.frames[i].image);
    if (tracked.cam_from_world)
      result.told.push_back({i, tracked.timestamp, *tracked.cam_from_world, tracked.map});
    result.mapped += tracked.mapping ? 1 : 0;
    if (!ask) continue;
    EXPECT_EQ(slam.trajectory().size(), static_cast<std::size_t>(i) + 1) << "the newest frame included";
    EXPECT_TRUE(same_bytes(slam.latest_poses(1), {slam.trajectory().back()}));
    EXPECT_EQ(slam.keyframe_trajectory().size(), static_cast<std::size_t>(slam.keyframes()));
    EXPECT_EQ(slam.landmark_positions().size(), static_cast<std::size_t>(slam.landmarks()));
    EXPECT_GT(slam.landmarks(), 0);
    EXPECT_EQ(slam.maps(), 1);
  }
  slam.finish();
  result.trajectory = slam.trajectory();
  return result;
}

TEST(SlamGetters, AskingOnEveryFrameChangesNoByte) {
  const Answers silent = run_asking(false), asked = run_asking(true);
  EXPECT_TRUE(same_bytes(silent.told, asked.told));
  EXPECT_TRUE(same_bytes(silent.trajectory, asked.trajectory));
  EXPECT_EQ(silent.mapped, asked.mapped);
  EXPECT_GT(asked.mapped, 1) << "mapping is reported, asked or not";
}

TEST(SlamGetters, BeforeTheFirstFrameThereIsNothing) {
  const Slam slam(TestSequence::of_a_desk().camera, getter_settings());
  EXPECT_TRUE(slam.trajectory().empty());
  EXPECT_TRUE(slam.keyframe_trajectory().empty());
  EXPECT_TRUE(slam.landmark_positions().empty());
  EXPECT_EQ(slam.maps(), 0);
  EXPECT_EQ(slam.keyframes(), 0);
}

TEST(SlamTimes, AFrameReportsItsOwnStagesOnly) {
  const TestSequence& sequence = TestSequence::of_a_desk();
  Slam slam(sequence.camera, getter_settings());
  for (int i = 0; i < 20; ++i) {
    RgbdImage image = sequence.frames[i].image;
    if (i >= 10 && i < 14) image.colour = cv::Mat(image.colour.size(), CV_8UC3, cv::Scalar::all(0));
    const TrackingResult result = slam.track(image);
    const StageTimes& times = result.milliseconds;
    if (i >= 11 && i < 14) {
      EXPECT_EQ(result.status, TrackingStatus::lost) << i;
      EXPECT_EQ(times.prediction, 0) << "of a frame before";
      EXPECT_EQ(times.local_map, 0) << "of a frame before";
      EXPECT_GT(times.relocalisation, 0);
    }
    if (i > 0 && i < 10) {
      EXPECT_GT(times.prediction, 0);
      EXPECT_GT(times.local_map, 0);
      EXPECT_EQ(times.relocalisation, 0);
    }
    const double stages = times.extraction + times.mask_wait + times.rejection + times.prediction +
                          times.local_map + times.relocalisation + times.keyframe + times.wait;
    EXPECT_LE(stages, times.total + 0.01) << i;
  }
}

}  // namespace
}  // namespace stdc
