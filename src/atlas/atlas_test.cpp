#include "atlas/atlas.hpp"

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

KeyframeId add_keyframe(Atlas& atlas, int frame, const Pose& pose,
                        const std::shared_ptr<const FrameFeatures>& seen) {
  return atlas.add_keyframe({frame, 0.1 * frame, pose, {}, seen, measure_keypoints(Camera(), {}, *seen)});
}

/// Three keyframes, one metre apart along x, that all see `landmarks` landmarks with keypoints 0, 1, ...
struct ThreeKeyframes {
  Atlas atlas;
  std::vector<KeyframeId> keyframes;
  std::vector<LandmarkId> landmarks;

  explicit ThreeKeyframes(int count = 20) {
    for (int k = 0; k < 3; ++k) {
      Pose cam_from_world;
      cam_from_world.translation.x() = -k;
      keyframes.push_back(add_keyframe(atlas, 10 * k, cam_from_world, features(count + 5, k)));
    }
    for (int i = 0; i < count; ++i) {
      landmarks.push_back(atlas.add_landmark({0.1 * i, 0, 4}, keyframes[0]));
      for (const KeyframeId keyframe : keyframes) EXPECT_TRUE(atlas.observe(keyframe, i, landmarks.back()));
      atlas.refresh(landmarks.back());
    }
    for (const KeyframeId keyframe : keyframes) atlas.update_covisibility(keyframe);
  }
};

/// Whatever is done to the map, both sides of every observation must agree.
void expect_consistent(const Atlas& atlas) {
  int seen = 0;
  for (const KeyframeId id : atlas.keyframe_ids()) {
    const Keyframe& keyframe = atlas.keyframe(id);
    for (int i = 0; i < static_cast<int>(keyframe.landmarks.size()); ++i) {
      if (!keyframe.landmarks[i].valid()) continue;
      ++seen;
      ASSERT_TRUE(atlas.has(keyframe.landmarks[i]));
      EXPECT_EQ(atlas.keypoint_of(keyframe.landmarks[i], id), i);
    }
    for (const Covisible& c : keyframe.covisible) EXPECT_TRUE(atlas.has(c.keyframe));
    EXPECT_TRUE(id.value == 0 || (keyframe.parent < id && atlas.has(keyframe.parent)));
  }
  int noted = 0;
  for (const LandmarkId id : atlas.landmark_ids())
    noted += static_cast<int>(atlas.landmark(id).observations.size());
  EXPECT_EQ(noted, seen);
}

TEST(Atlas, ObservationsStandOnBothSides) {
  ThreeKeyframes scene;
  expect_consistent(scene.atlas);
  EXPECT_FALSE(scene.atlas.observe(scene.keyframes[0], 0, scene.landmarks[3])) << "the keypoint is taken";
  EXPECT_FALSE(scene.atlas.observe(scene.keyframes[0], 22, scene.landmarks[3]))
      << "the landmark is seen already";
  for (const KeyframeId keyframe : scene.keyframes) scene.atlas.remove_observation(keyframe, 3);
  EXPECT_FALSE(scene.atlas.has(scene.landmarks[3])) << "a landmark that nobody sees is freed";
  expect_consistent(scene.atlas);
}

TEST(Atlas, CovisibilityCountsSharedLandmarks) {
  const ThreeKeyframes scene;
  const Keyframe& last = scene.atlas.keyframe(scene.keyframes[2]);
  ASSERT_EQ(last.covisible.size(), 2U);
  EXPECT_EQ(last.covisible[0].keyframe, scene.keyframes[0]);
  EXPECT_EQ(last.covisible[0].shared, 20);
  EXPECT_EQ(last.parent, scene.keyframes[0]);
}

TEST(Atlas, MergeGivesAllObservationsToOne) {
  ThreeKeyframes scene;
  const LandmarkId twin = scene.atlas.add_landmark({0, 0, 4}, scene.keyframes[1]);
  scene.atlas.remove_observation(scene.keyframes[0], 0);
  ASSERT_TRUE(scene.atlas.observe(scene.keyframes[0], 21, twin));
  ASSERT_TRUE(scene.atlas.observe(scene.keyframes[1], 22, twin));
  scene.atlas.merge(twin, scene.landmarks[0]);
  EXPECT_FALSE(scene.atlas.has(twin));
  EXPECT_EQ(scene.atlas.landmark(scene.landmarks[0]).observations.size(), 3U);
  EXPECT_EQ(scene.atlas.keypoint_of(scene.landmarks[0], scene.keyframes[1]), 0)
      << "the older observation stays";
  expect_consistent(scene.atlas);
}

TEST(Atlas, RemovedKeyframesAreFoundRelativeToWhatIsLeft) {
  ThreeKeyframes scene;
  const Pose before = scene.atlas.keyframe(scene.keyframes[2]).cam_from_world;
  scene.atlas.remove(scene.keyframes[2]);
  scene.atlas.remove(scene.keyframes[1]);
  expect_consistent(scene.atlas);
  const Atlas::KeptAncestor ancestor = scene.atlas.resolve(scene.keyframes[2]);
  EXPECT_EQ(ancestor.keyframe, scene.keyframes[0]);
  const Pose after = ancestor.cam_from_ancestor * scene.atlas.keyframe(ancestor.keyframe).cam_from_world;
  EXPECT_LT((after.translation - before.translation).norm(), 1e-12);
  scene.atlas.remove(scene.keyframes[0]);
  EXPECT_TRUE(scene.atlas.has(scene.keyframes[0])) << "the first keyframe holds the world's origin";
}

TEST(Atlas, RefreshTakesTheMiddleDescriptorAndTheMeanDirection) {
  const ThreeKeyframes scene;
  const Landmark& landmark =
      scene.atlas.landmark(scene.landmarks[10]);  // at x = 1, in front of the middle camera
  EXPECT_NEAR(landmark.direction.x(), 0, 1e-6);
  EXPECT_NEAR(landmark.max_distance, std::sqrt(17.0), 1e-5);
  EXPECT_NEAR(landmark.min_distance, std::sqrt(17.0) / std::pow(1.2, 5), 1e-5);
}

TEST(Atlas, SurvivesARandomLife) {
  Atlas atlas;
  Random random(5);
  std::vector<KeyframeId> keyframes;
  for (int step = 0; step < 60; ++step) {
    keyframes.push_back(add_keyframe(atlas, step, Pose(), features(60)));
    for (int i = 0; i < 40; ++i) {
      const auto ids = atlas.landmark_ids();
      const LandmarkId landmark = ids.empty() || random.below(3) == 0
                                      ? atlas.add_landmark({random.uniform(), 0, 3}, keyframes.back())
                                      : ids[random.below(static_cast<std::uint32_t>(ids.size()))];
      if (!atlas.observe(keyframes.back(), static_cast<int>(random.below(60)), landmark) &&
          atlas.landmark(landmark).observations.empty()) {
        atlas.remove(landmark);
      }
    }
    atlas.update_covisibility(keyframes.back());
    const auto ids = atlas.landmark_ids();
    atlas.merge(ids[random.below(static_cast<std::uint32_t>(ids.size()))], ids[0]);
    const auto left = atlas.keyframe_ids();
    if (left.size() > 12) atlas.remove(left[1 + random.below(static_cast<std::uint32_t>(left.size() - 1))]);
    expect_consistent(atlas);
  }
  EXPECT_LE(atlas.keyframe_count(), 13);
}

}  // namespace
}  // namespace stdc
