#include "tracking/keyframe_policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tracking/test_frames.hpp"

namespace stdc {
namespace {

/// A frame right after the last of four keyframes that see the same: nothing asks for a keyframe.
struct Settled {
  test::MappedScene mapped;
  LocalMap local;
  test::View view;
  TrackedFrame frame;
  TrackingSettings settings;
  int frames_since = 1, keyframes = 4;

  Settled() : mapped(test::Scene(400)) {
    for (int k = 0; k < 4; ++k) mapped.add(mapped.scene.look(test::camera_at(0.02 * k, 0, 0)));
    local = make_local_map(mapped.atlas, mapped.atlas.keyframe({3}).landmarks, {3}, 10);
    view = mapped.scene.look(local.reference_from_world);
    frame = test::tracked_frame(mapped, view, 31);
    settings.min_close_tracked = 50;
    settings.min_close_untracked = 30;
  }
  bool asks() const {
    return needs_keyframe(mapped.scene.camera, frame, local, frames_since, keyframes, settings);
  }
  /// Takes the landmarks of the last `count` keypoints away.
  void untrack(int count) {
    for (int i = frame.features->size() - count; i < frame.features->size(); ++i) frame.landmarks[i] = {};
  }
};

TEST(KeyframePolicy, AFrameLikeTheReferenceIsNotNeeded) {
  const Settled scene;
  EXPECT_GT(scene.frame.inliers, 150);
  EXPECT_FALSE(scene.asks());
}

TEST(KeyframePolicy, FewCloseTrackedAndManyToAdd) {
  Settled scene;
  scene.settings.close_depth = 10;
  const int keypoints = scene.frame.features->size();
  scene.untrack(keypoints - 45);
  EXPECT_TRUE(scene.asks());
  scene.settings.min_close_tracked = 45;
  EXPECT_FALSE(scene.asks()) << "45 are not fewer than 45";
  scene.settings.min_close_tracked = 50;
  scene.settings.min_close_untracked = keypoints - 45;
  EXPECT_FALSE(scene.asks()) << "little could be added";
  scene.settings.min_close_untracked = 30;
  scene.settings.close_depth = 0.5;
  EXPECT_FALSE(scene.asks()) << "nothing is close";
  scene.settings.close_depth = 10;
  for (Measurement& m : scene.frame.measurements) m.depth = 0;
  EXPECT_FALSE(scene.asks()) << "nothing has depth";
}

TEST(KeyframePolicy, FewOfTheReferencesLandmarksTracked) {
  Settled scene;
  const int reference = scene.local.count_reference_landmarks(true);
  scene.frame.inliers = static_cast<int>(scene.settings.tracked_ratio * reference) - 1;
  EXPECT_TRUE(scene.asks());
  scene.frame.inliers = static_cast<int>(scene.settings.tracked_ratio * reference) + 1;
  EXPECT_FALSE(scene.asks());
}

TEST(KeyframePolicy, YoungMapsCountLandmarksThatAreNotEstablished) {
  Settled scene;
  for (LocalLandmark& landmark : scene.local.landmarks) landmark.established = false;
  scene.frame.inliers = 20;
  EXPECT_FALSE(scene.asks());
  scene.keyframes = 2;
  EXPECT_TRUE(scene.asks());
}

TEST(KeyframePolicy, TheViewHasMovedOn) {
  Settled scene;
  const Pose here = scene.frame.cam_from_world;
  const double depth = 2.9;  // about the median of what is seen
  scene.frame.cam_from_world.translation.x() += 1.4 * scene.settings.parallax_ratio * depth;
  EXPECT_TRUE(scene.asks());
  scene.frame.cam_from_world = here;
  scene.frame.cam_from_world.translation.x() += 0.6 * scene.settings.parallax_ratio * depth;
  EXPECT_FALSE(scene.asks());
  scene.frame.cam_from_world = Pose(rotation_exp({0, 0.4, 0}), Eigen::Vector3d::Zero()) * here;
  EXPECT_FALSE(scene.asks()) << "turning gives no parallax";
}

TEST(KeyframePolicy, LongAgoAndLandmarksAreBeingLost) {
  Settled scene;
  const int reference = scene.local.count_reference_landmarks(true);
  scene.frame.inliers = static_cast<int>(0.85 * reference);
  EXPECT_FALSE(scene.asks());
  scene.frames_since = 30;  // a second
  EXPECT_TRUE(scene.asks());
  scene.frame.inliers = static_cast<int>(0.95 * reference);
  EXPECT_FALSE(scene.asks()) << "nothing is being lost";
}

TEST(KeyframePolicy, InsertsWithTheFramesLandmarksAndMakesCloseOnes) {
  Settled scene;
  Atlas& atlas = scene.mapped.atlas;
  const NoiseSettings noise;
  scene.settings.close_depth = 2.8;
  scene.settings.initial_landmarks = 5;
  scene.untrack(100);
  scene.frame.measurements[0].scale = 0.7F;  // aligned by the tracker
  const TrackedFrame before = scene.frame;
  const int landmarks = atlas.landmark_count();
  const KeyframeId id =
      insert_keyframe(atlas, {scene.mapped.scene.camera, noise}, scene.frame, scene.settings);
  test::expect_consistent(atlas);
  const Keyframe& keyframe = atlas.keyframe(id);
  EXPECT_EQ(keyframe.frame, 31);
  EXPECT_EQ(keyframe.features, before.features);
  EXPECT_EQ(keyframe.landmarks, scene.frame.landmarks);
  EXPECT_EQ(keyframe.measurements[0].scale, 0.7F);
  int made = 0;
  for (int i = 0; i < before.features->size(); ++i) {
    const float depth = before.measurements[i].depth;
    if (before.landmarks[i].valid()) {
      EXPECT_EQ(keyframe.landmarks[i], before.landmarks[i]);
      continue;
    }
    EXPECT_EQ(keyframe.landmarks[i].valid(), depth > 0 && depth <= 2.8F);
    if (!keyframe.landmarks[i].valid()) continue;
    ++made;
    const Landmark& landmark = atlas.landmark(keyframe.landmarks[i]);
    const Eigen::Vector3d truth = scene.mapped.scene.points[scene.view.points[i]].position;
    EXPECT_LT((landmark.position - truth).norm(), 1e-3);
    EXPECT_EQ(landmark.created_by, id);
    EXPECT_EQ(landmark.descriptor, before.features->descriptor(i));
    EXPECT_GT(landmark.max_distance, 0);
    EXPECT_FLOAT_EQ(keyframe.measurements[i].scale, before.features->scale_of(i) * 0.5F) << "it is an anchor";
  }
  EXPECT_GT(made, 5);
  EXPECT_EQ(atlas.landmark_count(), landmarks + made);
}

TEST(KeyframePolicy, TheFirstKeyframeMakesAllLandmarksItCan) {
  Settled scene;
  scene.settings.close_depth = 0.5;
  scene.settings.initial_landmarks = 40;
  scene.untrack(scene.frame.features->size());
  Atlas atlas;
  insert_keyframe(atlas, {scene.mapped.scene.camera, {}}, scene.frame, scene.settings);
  const auto with_depth = std::count_if(scene.frame.measurements.begin(), scene.frame.measurements.end(),
                                        [](const Measurement& m) { return m.depth > 0; });
  EXPECT_EQ(atlas.landmark_count(), with_depth);
}

TEST(KeyframePolicy, MakesTheNearestLandmarksWhereNothingIsClose) {
  Settled scene;
  scene.settings.close_depth = 0.5;
  scene.settings.initial_landmarks = 40;
  scene.untrack(scene.frame.features->size());
  Atlas& atlas = scene.mapped.atlas;
  const int before = atlas.landmark_count();
  const KeyframeId id = insert_keyframe(atlas, {scene.mapped.scene.camera, {}}, scene.frame, scene.settings);
  EXPECT_EQ(atlas.landmark_count() - before, 40);
  double furthest = 0, nearest_left = 1e9;
  for (int i = 0; i < scene.frame.features->size(); ++i) {
    const double z = scene.frame.measurements[i].depth;
    if (atlas.keyframe(id).landmarks[i].valid()) {
      furthest = std::max(furthest, z);
    } else if (z > 0) {
      nearest_left = std::min(nearest_left, z);
    }
  }
  EXPECT_LE(furthest, nearest_left);
}

TEST(KeyframePolicy, LandmarksThatAreGoneAreMadeAnew) {
  Settled scene;
  Atlas& atlas = scene.mapped.atlas;
  scene.settings.close_depth = 10;
  const LandmarkId gone = scene.frame.landmarks[7], twice = scene.frame.landmarks[8];
  atlas.remove(gone);
  scene.frame.landmarks[9] = twice;  // merged since: two keypoints have the same landmark now
  const KeyframeId id = insert_keyframe(atlas, {scene.mapped.scene.camera, {}}, scene.frame, scene.settings);
  test::expect_consistent(atlas);
  EXPECT_EQ(atlas.keyframe(id).landmarks[8], twice);
  EXPECT_EQ(atlas.keypoint_of(twice, id), 8);
  EXPECT_NE(scene.frame.landmarks[7], gone);
  EXPECT_NE(scene.frame.landmarks[9], twice);
  EXPECT_TRUE(atlas.has(scene.frame.landmarks[7]) && atlas.has(scene.frame.landmarks[9]));
}

}  // namespace
}  // namespace stdc
