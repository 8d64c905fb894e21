#include "slam/slam.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "core/error.hpp"
#include "slam/system_tests/test_load.hpp"
#include "slam/system_tests/test_sequence.hpp"

namespace stdc {
namespace {

using test::Load;
using test::same_bytes;
using test::TestSequence;

Settings small_settings() {
  Settings settings;
  settings.features.keypoints = 500;
  return settings;
}

using Change = std::function<void(int, RgbdImage&)>;

struct Outcome {
  std::vector<TrackingStatus> status;
  std::vector<FramePose> trajectory;
  int landmarks = 0, keyframes = 0;

  int count(TrackingStatus wanted, int from, int to) const {
    return static_cast<int>(std::count(status.begin() + from, status.begin() + to, wanted));
  }
};

Outcome run(
    const Settings& settings, int frames, const Change& change = [](int, RgbdImage&) {}) {
  const TestSequence& sequence = TestSequence::of_a_desk();
  Slam slam(sequence.camera, settings);
  Outcome result;
  for (int i = 0; i < frames; ++i) {
    RgbdImage image = sequence.frames[i].image;
    image.colour = image.colour.clone();
    image.depth = image.depth.clone();
    change(i, image);
    const TrackingResult tracked = slam.track(image);
    EXPECT_EQ(tracked.status == TrackingStatus::ok, tracked.cam_from_world.has_value());
    EXPECT_EQ(tracked.frame, i);
    result.status.push_back(tracked.status);
  }
  slam.finish();
  result.trajectory = slam.trajectory();
  result.landmarks = slam.landmarks();
  result.keyframes = slam.keyframes();
  return result;
}

/// The largest distance from the truth, with the first frame as the world [m].
double worst_error(const Outcome& result) {
  const TestSequence& sequence = TestSequence::of_a_desk();
  const Pose first_from_truth = sequence.frames[0].world_from_cam.inverse();
  double worst = 0;
  for (const FramePose& pose : result.trajectory) {
    const Pose truth = first_from_truth * sequence.frames[pose.frame].world_from_cam;
    worst = std::max(worst, (truth.translation - pose.world_from_cam.translation).norm());
  }
  return worst;
}

TEST(Slam, TracksEveryFrameOfADesk) {
  const Outcome result = run(small_settings(), 100);
  EXPECT_EQ(result.count(TrackingStatus::ok, 0, 100), 100);
  EXPECT_EQ(result.trajectory.size(), 100U);
  EXPECT_LT(worst_error(result), 0.03);
  EXPECT_GT(result.keyframes, 1);
}

TEST(Slam, GivesTheSameBytesOnALoadedMachine) {
  const Outcome alone = run(small_settings(), 60);
  const Load load;
  const Outcome loaded = run(small_settings(), 60);
  EXPECT_TRUE(same_bytes(alone.trajectory, loaded.trajectory));
}

TEST(Slam, TheMappersPaceDoesNotDecideTheResult) {
  // A tracker that is slowed down gives the mapper all the time it wants; the result is taken in at the same
  // frame all the same.
  const Outcome fast = run(small_settings(), 40);
  const Outcome slow = run(small_settings(), 40, [](int i, RgbdImage&) {
    if (i % 5 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(60));
  });
  EXPECT_TRUE(same_bytes(fast.trajectory, slow.trajectory));
}

TEST(Slam, ComesBackAfterBlackFrames) {
  const Outcome result = run(small_settings(), 100, [](int i, RgbdImage& image) {
    if (i >= 40 && i < 55) image.colour.setTo(0);
  });
  EXPECT_EQ(result.count(TrackingStatus::ok, 0, 40), 40);
  EXPECT_EQ(result.count(TrackingStatus::lost, 40, 55), 15);
  EXPECT_EQ(result.count(TrackingStatus::ok, 58, 100), 42) << "found again within three frames";
  EXPECT_LT(worst_error(result), 0.04);
}

TEST(Slam, GoesOnWithoutDepth) {
  const Outcome result = run(small_settings(), 60, [](int i, RgbdImage& image) {
    if (i >= 20 && i < 50) image.depth.setTo(0);
  });
  EXPECT_EQ(result.count(TrackingStatus::ok, 0, 60), 60);
  EXPECT_LT(worst_error(result), 0.05);
}

TEST(Slam, WaitsForAFrameWithDepthToBegin) {
  const Outcome result = run(small_settings(), 20, [](int i, RgbdImage& image) {
    if (i < 5) image.depth.setTo(0);
  });
  EXPECT_EQ(result.count(TrackingStatus::initialising, 0, 5), 5);
  EXPECT_EQ(result.count(TrackingStatus::ok, 5, 20), 15);
  EXPECT_EQ(result.trajectory.front().frame, 5);
}

TEST(Slam, SurvivesGarbage) {
  cv::RNG noise(7);
  const Outcome result = run(small_settings(), 60, [&](int i, RgbdImage& image) {
    if (i % 10 == 3) image.colour.setTo(255);
    if (i % 10 == 4) noise.fill(image.colour, cv::RNG::UNIFORM, 0, 255);
    if (i % 10 == 5) noise.fill(image.depth, cv::RNG::UNIFORM, 0, 65535);
  });
  EXPECT_EQ(result.status.size(), 60U);
  EXPECT_GT(result.count(TrackingStatus::ok, 0, 60), 35);
}

TEST(Slam, AMapDoesNotGrowWhileTheCameraStays) {
  const auto frame_of = [](int i) { return i < 50 ? i : 99 - i; };
  const TestSequence& sequence = TestSequence::of_a_desk();
  Slam slam(sequence.camera, small_settings());
  std::vector<int> landmarks, keyframes;
  for (int round = 0; round < 6; ++round) {  // to and fro over the same place
    for (int i = 0; i < 100; ++i) {
      RgbdImage image = sequence.frames[frame_of(i)].image;
      image.timestamp = (round * 100 + i) / 30.0;
      slam.track(image);
    }
    landmarks.push_back(slam.landmarks());
    keyframes.push_back(slam.keyframes());
  }
  EXPECT_LE(landmarks.back(), 1.25 * landmarks[1]);
  EXPECT_LE(keyframes.back(), keyframes[1] + 4);
}

TEST(Slam, SkippedFramesAreCounted) {
  const TestSequence& sequence = TestSequence::of_a_desk();
  Slam slam(sequence.camera, small_settings());
  slam.track(sequence.frames[0].image);
  const TrackingResult skipped = slam.skip(sequence.frames[1].image.timestamp);
  EXPECT_EQ(skipped.status, TrackingStatus::skipped);
  EXPECT_EQ(skipped.frame, 1);
  EXPECT_EQ(slam.track(sequence.frames[2].image).frame, 2);
}

TEST(Slam, RefusesWhatNoCameraGives) {
  const TestSequence& sequence = TestSequence::of_a_desk();
  Slam slam(sequence.camera, small_settings());
  RgbdImage image = sequence.frames[0].image;
  slam.track(image);
  image.timestamp = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(slam.track(image), Error);
  image.timestamp = 1e6;
  image.colour = cv::Mat(10, 10, CV_8UC3);
  EXPECT_THROW(slam.track(image), Error);
  image = sequence.frames[1].image;
  image.depth = cv::Mat(240, 320, CV_8UC1);
  EXPECT_THROW(slam.track(image), Error);
  EXPECT_EQ(slam.track(sequence.frames[1].image).status, TrackingStatus::ok) << "and goes on";
  Settings bad = small_settings();
  bad.features.keypoints = -1;
  EXPECT_THROW(Slam(sequence.camera, bad), Error);
  Camera camera = sequence.camera;
  camera.fx = 0;
  EXPECT_THROW(Slam(camera, small_settings()), Error);
}

TEST(Slam, MissingDepthImageIsAllowed) {
  const Outcome result = run(small_settings(), 10, [](int i, RgbdImage& image) {
    if (i > 2) image.depth = cv::Mat();
  });
  EXPECT_EQ(result.count(TrackingStatus::ok, 0, 10), 10);
}

}  // namespace
}  // namespace stdc
