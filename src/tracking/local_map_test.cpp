#include "tracking/local_map.hpp"

#include <gtest/gtest.h>

#include <set>

#include "atlas/test_scene.hpp"

namespace stdc {
namespace {

/// Six keyframes in a row along the wall, 0.4 m apart.
test::MappedScene row_of_keyframes() {
  test::MappedScene mapped(test::Scene(400));
  for (int k = 0; k < 6; ++k) mapped.add(mapped.scene.look(test::camera_at(0.4 * k, 0, 0)));
  return mapped;
}

std::set<LandmarkId> landmarks_of(const Atlas& atlas, const std::vector<KeyframeId>& keyframes) {
  std::set<LandmarkId> ids;
  for (const KeyframeId keyframe : keyframes) {
    for (const LandmarkId id : atlas.keyframe(keyframe).landmarks) {
      if (id.valid()) ids.insert(id);
    }
  }
  return ids;
}

std::set<LandmarkId> ids_of(const LocalMap& local) {
  std::set<LandmarkId> ids;
  for (const LocalLandmark& landmark : local.landmarks) ids.insert(landmark.id);
  return ids;
}

TEST(LocalMap, HoldsTheLandmarksOfTheKeyframesThatShareMost) {
  const test::MappedScene mapped = row_of_keyframes();
  const auto& seen = mapped.atlas.keyframe({3}).landmarks;
  const LocalMap local = make_local_map(mapped.atlas, seen, {0}, 3);
  EXPECT_EQ(local.reference, KeyframeId{3});
  // The two keyframes that see most of what the fourth sees.
  const auto& covisible = mapped.atlas.keyframe({3}).covisible;
  EXPECT_EQ(ids_of(local), landmarks_of(mapped.atlas, {{3}, covisible[0].keyframe, covisible[1].keyframe}));
  const LocalMap all = make_local_map(mapped.atlas, seen, {0}, 100);
  EXPECT_EQ(static_cast<int>(all.landmarks.size()), mapped.atlas.landmark_count())
      << "neighbours of neighbours reach the ends of the row";
}

TEST(LocalMap, TakesNeighboursOfWhatSeesTheFrame) {
  const test::MappedScene mapped = row_of_keyframes();
  // A landmark that only the first keyframe sees.
  std::vector<LandmarkId> seen;
  for (const LandmarkId id : mapped.atlas.keyframe({0}).landmarks) {
    if (mapped.atlas.landmark(id).observations.size() == 1) seen.push_back(id);
  }
  ASSERT_FALSE(seen.empty());
  const KeyframeId neighbour = mapped.atlas.keyframe({0}).covisible.front().keyframe;
  const LocalMap local = make_local_map(mapped.atlas, seen, {5}, 2);
  EXPECT_EQ(local.reference, KeyframeId{0});
  EXPECT_EQ(ids_of(local), landmarks_of(mapped.atlas, {{0}, neighbour}));
}

TEST(LocalMap, IsSortedAndCopiesEveryField) {
  const test::MappedScene mapped = row_of_keyframes();
  const LocalMap local = make_local_map(mapped.atlas, mapped.atlas.keyframe({2}).landmarks, {0}, 4);
  EXPECT_TRUE(std::is_sorted(local.landmarks.begin(), local.landmarks.end(),
                             [](const auto& a, const auto& b) { return a.id < b.id; }));
  EXPECT_LE(local.reference_views.size(), 6U) << "each anchor once";
  for (std::size_t i = 0; i < local.landmarks.size(); ++i) {
    const LocalLandmark& copy = local.landmarks[i];
    const Landmark& original = mapped.atlas.landmark(copy.id);
    EXPECT_EQ(local.find(copy.id), static_cast<int>(i));
    EXPECT_EQ(copy.position, original.position);
    EXPECT_EQ(copy.direction, original.direction);
    EXPECT_EQ(copy.descriptor, original.descriptor);
    EXPECT_EQ(copy.min_distance, original.min_distance);
    EXPECT_EQ(copy.max_distance, original.max_distance);
    EXPECT_EQ(copy.established, original.observations.size() >= 3);
    const Observation& oldest = original.observations.front();
    const Keyframe& anchor = mapped.atlas.keyframe(oldest.keyframe);
    EXPECT_EQ(local.reference_views[copy.view].features, anchor.features);
    EXPECT_EQ(copy.view_keypoint, oldest.keypoint);
    EXPECT_EQ(copy.view_pixel, anchor.measurements[oldest.keypoint].seen);
  }
  EXPECT_EQ(local.find({}), -1);
  EXPECT_EQ(local.find({static_cast<std::uint32_t>(mapped.atlas.landmark_id_limit())}), -1);
}

TEST(LocalMap, PointsFromTheReferencesKeypointsToItsLandmarks) {
  const test::MappedScene mapped = row_of_keyframes();
  const LocalMap local = make_local_map(mapped.atlas, mapped.atlas.keyframe({2}).landmarks, {0}, 3);
  const Keyframe& reference = mapped.atlas.keyframe(local.reference);
  EXPECT_EQ(local.reference_features, reference.features);
  EXPECT_LT(test::centre_error(local.reference_from_world, reference.cam_from_world), 1e-12);
  ASSERT_EQ(local.reference_landmarks.size(), reference.landmarks.size());
  int established = 0;
  for (std::size_t i = 0; i < reference.landmarks.size(); ++i) {
    ASSERT_GE(local.reference_landmarks[i], 0);
    EXPECT_EQ(local.landmarks[local.reference_landmarks[i]].id, reference.landmarks[i]);
    established += mapped.atlas.landmark(reference.landmarks[i]).observations.size() >= 3 ? 1 : 0;
  }
  EXPECT_EQ(local.count_reference_landmarks(false), reference.features->size());
  EXPECT_EQ(local.count_reference_landmarks(true), established);
}

TEST(LocalMap, PassesOverLandmarksThatAreGone) {
  test::MappedScene mapped = row_of_keyframes();
  std::vector<LandmarkId> seen = mapped.atlas.keyframe({4}).landmarks;
  seen.emplace_back();
  for (std::size_t i = 0; i < seen.size() / 2; ++i) mapped.atlas.remove(seen[i]);
  const LocalMap local = make_local_map(mapped.atlas, seen, {0}, 4);
  EXPECT_EQ(local.reference, KeyframeId{4});
  for (std::size_t i = 0; i < seen.size() / 2; ++i) {
    EXPECT_EQ(local.find(seen[i]), -1);
    EXPECT_EQ(local.reference_landmarks[i], -1);
  }
  EXPECT_GE(local.find(seen[seen.size() / 2]), 0);
}

TEST(LocalMap, FallsBackToAKeyframeEvenIfThatIsGone) {
  test::MappedScene mapped = row_of_keyframes();
  const LocalMap local = make_local_map(mapped.atlas, {}, {3}, 1);
  EXPECT_EQ(local.reference, KeyframeId{3});
  EXPECT_EQ(ids_of(local), landmarks_of(mapped.atlas, {{3}}));
  const KeyframeId parent = mapped.atlas.keyframe({3}).parent;
  mapped.atlas.remove(KeyframeId{3});
  EXPECT_EQ(make_local_map(mapped.atlas, {}, {3}, 1).reference, parent);
}

TEST(LocalMap, OfAKeyframeWithoutLandmarksIsEmpty) {
  test::MappedScene mapped(test::Scene(40));
  mapped.add_bare(mapped.scene.look(Pose()));
  const LocalMap local = make_local_map(mapped.atlas, {}, {0}, 5);
  EXPECT_EQ(local.reference, KeyframeId{0});
  EXPECT_TRUE(local.landmarks.empty());
  EXPECT_EQ(local.count_reference_landmarks(false), 0);
}

}  // namespace
}  // namespace stdc
