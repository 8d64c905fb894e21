#include "map/map.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace stdc {
namespace {

std::shared_ptr<const FrameFeatures> features(int count, std::uint64_t seed = 1) {
  Random random(seed);
  Features raw;
  raw.keypoints.resize(count);
  raw.descriptors.resize(count);
  for (Descriptor& descriptor : raw.descriptors) {
    for (auto& word : descriptor.bits) word = (std::uint64_t{random.next()} << 32U) | random.next();
  }
  return std::make_shared<FrameFeatures>(Camera(), std::move(raw), cv::Mat(), 1.2, 6, nullptr);
}

KeyframeId add_keyframe(Map& map, int frame, const Pose& pose,
                        const std::shared_ptr<const FrameFeatures>& seen) {
  return map.add_keyframe({frame, 0.1 * frame, pose, {}, seen, measure_keypoints(Camera(), {}, *seen)});
}

/// Three keyframes, one metre apart along x, that all see `landmarks` landmarks with keypoints 0, 1, ...
struct ThreeKeyframes {
  Map map;
  std::vector<KeyframeId> keyframes;
  std::vector<LandmarkId> landmarks;

  explicit ThreeKeyframes(int count = 20) {
    for (int k = 0; k < 3; ++k) {
      Pose cam_from_world;
      cam_from_world.translation.x() = -k;
      keyframes.push_back(add_keyframe(map, 10 * k, cam_from_world, features(count + 5, k)));
    }
    for (int i = 0; i < count; ++i) {
      landmarks.push_back(map.add_landmark({0.1 * i, 0, 4}, keyframes[0]));
      for (const KeyframeId keyframe : keyframes) EXPECT_TRUE(map.observe(keyframe, i, landmarks.back()));
      map.refresh(landmarks.back());
    }
    for (const KeyframeId keyframe : keyframes) map.update_covisibility(keyframe);
  }
};

/// Whatever is done to the map, both sides of every observation must agree.
void expect_consistent(const Map& map) {
  int seen = 0;
  for (const KeyframeId id : map.keyframe_ids()) {
    const Keyframe& keyframe = map.keyframe(id);
    for (int i = 0; i < static_cast<int>(keyframe.landmarks.size()); ++i) {
      if (!keyframe.landmarks[i].valid()) continue;
      ++seen;
      ASSERT_TRUE(map.has(keyframe.landmarks[i]));
      EXPECT_EQ(map.keypoint_of(keyframe.landmarks[i], id), i);
    }
    for (const Covisible& c : keyframe.covisible) EXPECT_TRUE(map.has(c.keyframe));
    EXPECT_TRUE(id.value == 0 || (keyframe.parent < id && map.has(keyframe.parent)));
  }
  int noted = 0;
  for (const LandmarkId id : map.landmark_ids())
    noted += static_cast<int>(map.landmark(id).observations.size());
  EXPECT_EQ(noted, seen);
}

TEST(Map, ObservationsStandOnBothSides) {
  ThreeKeyframes scene;
  expect_consistent(scene.map);
  EXPECT_FALSE(scene.map.observe(scene.keyframes[0], 0, scene.landmarks[3])) << "the keypoint is taken";
  EXPECT_FALSE(scene.map.observe(scene.keyframes[0], 22, scene.landmarks[3]))
      << "the landmark is seen already";
  for (const KeyframeId keyframe : scene.keyframes) scene.map.forget(keyframe, 3);
  EXPECT_FALSE(scene.map.has(scene.landmarks[3])) << "a landmark that nobody sees is freed";
  expect_consistent(scene.map);
}

TEST(Map, CovisibilityCountsSharedLandmarks) {
  const ThreeKeyframes scene;
  const Keyframe& last = scene.map.keyframe(scene.keyframes[2]);
  ASSERT_EQ(last.covisible.size(), 2U);
  EXPECT_EQ(last.covisible[0].keyframe, scene.keyframes[0]);
  EXPECT_EQ(last.covisible[0].shared, 20);
  EXPECT_EQ(last.parent, scene.keyframes[0]);
}

TEST(Map, MergeGivesAllObservationsToOne) {
  ThreeKeyframes scene;
  const LandmarkId twin = scene.map.add_landmark({0, 0, 4}, scene.keyframes[1]);
  scene.map.forget(scene.keyframes[0], 0);
  ASSERT_TRUE(scene.map.observe(scene.keyframes[0], 21, twin));
  ASSERT_TRUE(scene.map.observe(scene.keyframes[1], 22, twin));
  scene.map.merge(twin, scene.landmarks[0]);
  EXPECT_FALSE(scene.map.has(twin));
  EXPECT_EQ(scene.map.landmark(scene.landmarks[0]).observations.size(), 3U);
  EXPECT_EQ(scene.map.keypoint_of(scene.landmarks[0], scene.keyframes[1]), 0)
      << "the older observation stays";
  expect_consistent(scene.map);
}

TEST(Map, RemovedKeyframesAreFoundRelativeToWhatIsLeft) {
  ThreeKeyframes scene;
  const Pose before = scene.map.keyframe(scene.keyframes[2]).cam_from_world;
  scene.map.remove(scene.keyframes[2]);
  scene.map.remove(scene.keyframes[1]);
  expect_consistent(scene.map);
  const Map::Anchor anchor = scene.map.resolve(scene.keyframes[2]);
  EXPECT_EQ(anchor.keyframe, scene.keyframes[0]);
  const Pose after = anchor.cam_from_anchor * scene.map.keyframe(anchor.keyframe).cam_from_world;
  EXPECT_LT((after.translation - before.translation).norm(), 1e-12);
  scene.map.remove(scene.keyframes[0]);
  EXPECT_TRUE(scene.map.has(scene.keyframes[0])) << "the first keyframe holds the world's origin";
}

TEST(Map, RefreshTakesTheMiddleDescriptorAndTheMeanDirection) {
  const ThreeKeyframes scene;
  const Landmark& landmark =
      scene.map.landmark(scene.landmarks[10]);  // at x = 1, in front of the middle camera
  EXPECT_NEAR(landmark.direction.x(), 0, 1e-6);
  EXPECT_NEAR(landmark.largest_distance, std::sqrt(17.0), 1e-5);
  EXPECT_NEAR(landmark.smallest_distance, std::sqrt(17.0) / std::pow(1.2, 5), 1e-5);
}

TEST(Map, SurvivesARandomLife) {
  Map map;
  Random random(5);
  std::vector<KeyframeId> keyframes;
  for (int step = 0; step < 60; ++step) {
    keyframes.push_back(add_keyframe(map, step, Pose(), features(60)));
    for (int i = 0; i < 40; ++i) {
      const auto ids = map.landmark_ids();
      const LandmarkId landmark = ids.empty() || random.below(3) == 0
                                      ? map.add_landmark({random.uniform(), 0, 3}, keyframes.back())
                                      : ids[random.below(static_cast<std::uint32_t>(ids.size()))];
      if (!map.observe(keyframes.back(), static_cast<int>(random.below(60)), landmark) &&
          map.landmark(landmark).observations.empty()) {
        map.remove(landmark);
      }
    }
    map.update_covisibility(keyframes.back());
    const auto ids = map.landmark_ids();
    map.merge(ids[random.below(static_cast<std::uint32_t>(ids.size()))], ids[0]);
    const auto left = map.keyframe_ids();
    if (left.size() > 12) map.remove(left[1 + random.below(static_cast<std::uint32_t>(left.size() - 1))]);
    expect_consistent(map);
  }
  EXPECT_LE(map.keyframe_count(), 13);
}

}  // namespace
}  // namespace stdc
