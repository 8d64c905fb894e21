#include "atlas/map_bundle.hpp"

#include <gtest/gtest.h>

#include <set>

#include "atlas/test_scene.hpp"

namespace stdc {
namespace {

constexpr KeyframeId keyframe_id(std::uint32_t value) { return {value}; }

/// Six keyframes along a metre.
class MapBundles : public ::testing::Test {
 protected:
  MapBundles() : mapped(test::Scene(250)) {
    noise.pixel_sigma = 0.5;
    noise.inverse_depth_sigma = 0.004;
    for (int k = 0; k < 6; ++k) {
      test::ViewOptions options;
      options.seed = 3 + k;
      mapped.add(mapped.scene.look(test::camera_at(0.2 * k, 0, 0.02 * k, 0, -0.02 * k), options));
    }
  }
  Atlas& atlas() { return mapped.atlas; }
  BundleResult adjust(MapBundle& bundle) const {
    return bundle_adjust(mapped.scene.camera, bundle.problem, noise, {});
  }

  test::MappedScene mapped;
  NoiseSettings noise;
};

TEST_F(MapBundles, LandmarksAreListedOnceAndByNumber) {
  std::set<std::uint32_t> expected;
  for (const std::uint32_t k : {4U, 2U}) {
    for (const LandmarkId landmark : atlas().keyframe(keyframe_id(k)).landmarks) {
      if (landmark.valid()) expected.insert(landmark.value);
    }
  }
  const std::vector<LandmarkId> landmarks = landmarks_of(atlas(), {keyframe_id(4), keyframe_id(2)});
  ASSERT_EQ(landmarks.size(), expected.size());
  EXPECT_TRUE(std::equal(landmarks.begin(), landmarks.end(), expected.begin(),
                         [](LandmarkId a, std::uint32_t b) { return a.value == b; }));
  EXPECT_TRUE(landmarks_of(atlas(), {}).empty());
}

TEST_F(MapBundles, ThoseThatSeeMostComeFirst) {
  const std::vector<KeyframeId> inside{keyframe_id(2), keyframe_id(3)};
  const std::vector<LandmarkId> landmarks = landmarks_of(atlas(), inside);
  const auto seen_by = [&](KeyframeId keyframe) {
    return std::count_if(landmarks.begin(), landmarks.end(),
                         [&](LandmarkId l) { return atlas().keypoint_of(l, keyframe) >= 0; });
  };
  const std::vector<KeyframeId> others = other_observers(atlas(), inside, 100);
  ASSERT_EQ(others.size(), 4U) << "none of the inside ones";
  for (std::size_t i = 0; i < others.size(); ++i) {
    EXPECT_TRUE(others[i] != keyframe_id(2) && others[i] != keyframe_id(3));
    if (i == 0) continue;
    EXPECT_GE(seen_by(others[i - 1]), seen_by(others[i]));
    if (seen_by(others[i - 1]) == seen_by(others[i])) {
      EXPECT_LT(others[i - 1], others[i]);
    }
  }
  const std::vector<KeyframeId> two = other_observers(atlas(), inside, 2);
  EXPECT_EQ(two, std::vector(others.begin(), others.begin() + 2));
  EXPECT_TRUE(other_observers(atlas(), inside, 0).empty());
}

TEST_F(MapBundles, AProblemHoldsEveryObservationOfThoseInIt) {
  const std::vector<KeyframeId> moving{keyframe_id(3), keyframe_id(4)}, fixed{keyframe_id(5), keyframe_id(1)};
  const MapBundle bundle = make_map_bundle(atlas(), moving, fixed);
  const BundleProblem& problem = bundle.problem;
  EXPECT_EQ(bundle.keyframes, (std::vector{keyframe_id(3), keyframe_id(4), keyframe_id(5), keyframe_id(1)}));
  EXPECT_EQ(bundle.moving, 2);
  EXPECT_EQ(problem.pose_fixed, (std::vector<std::uint8_t>{0, 0, 1, 1}));
  EXPECT_EQ(bundle.landmarks, landmarks_of(atlas(), moving)) << "not those that only the fixed ones see";
  ASSERT_EQ(problem.points.size(), bundle.landmarks.size());
  ASSERT_EQ(problem.observations.size(), bundle.keypoints.size());
  std::size_t expected = 0;
  for (const LandmarkId landmark : bundle.landmarks) {
    for (const KeyframeId keyframe : bundle.keyframes)
      expected += atlas().keypoint_of(landmark, keyframe) >= 0 ? 1 : 0;
  }
  EXPECT_EQ(problem.observations.size(), expected);
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    const BundleObservation& o = problem.observations[i];
    const KeyframeId keyframe = bundle.keyframes[o.pose];
    EXPECT_EQ(atlas().keypoint_of(bundle.landmarks[o.point], keyframe), bundle.keypoints[i]);
    const Measurement& measurement = atlas().keyframe(keyframe).measurements[bundle.keypoints[i]];
    EXPECT_EQ(o.pixel, measurement.pixel);
    EXPECT_EQ(o.depth, measurement.depth);
    EXPECT_EQ(o.scale, measurement.scale);
    EXPECT_EQ(problem.points[o.point], atlas().landmark(bundle.landmarks[o.point]).position);
    EXPECT_TRUE(i == 0 || problem.observations[i - 1].point <= o.point) << "grouped by point";
  }
}

TEST_F(MapBundles, TheRootOfAnyMapIsFixed) {
  EXPECT_EQ(make_map_bundle(atlas(), {keyframe_id(0), keyframe_id(1)}, {}).problem.pose_fixed,
            (std::vector<std::uint8_t>{1, 0}));
  mapped.start_map();
  for (int k = 0; k < 2; ++k) mapped.add(mapped.scene.look(test::camera_at(0.2 * k, 0, 0)));
  const MapBundle bundle = make_map_bundle(atlas(), {keyframe_id(6), keyframe_id(7)}, {});
  EXPECT_EQ(bundle.problem.pose_fixed, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_EQ(bundle.problem.points.size(), landmarks_of(atlas(), {keyframe_id(6), keyframe_id(7)}).size());
  atlas().join({1}, {0});
  EXPECT_EQ(make_map_bundle(atlas(), {keyframe_id(6), keyframe_id(7)}, {}).problem.pose_fixed,
            (std::vector<std::uint8_t>{0, 0}));
}

TEST_F(MapBundles, TheSolutionIsTakenIn) {
  for (std::uint32_t k = 1; k < 6; ++k) {
    Vector6d twist;
    twist << 0.01, -0.008, 0.006, 0.002, -0.003, 0.002;
    atlas().set_pose(keyframe_id(k), Pose::exp(twist) * mapped.views[k].cam_from_world);
  }
  for (const LandmarkId landmark : atlas().landmark_ids()) {
    atlas().set_position(landmark, atlas().landmark(landmark).position + Eigen::Vector3d(0.01, 0.01, -0.01));
    atlas().refresh_geometry(landmark);
  }
  MapBundle bundle = make_map_bundle(
      atlas(), {keyframe_id(1), keyframe_id(2), keyframe_id(3), keyframe_id(4), keyframe_id(5)},
      {keyframe_id(0)});
  const BundleResult result = adjust(bundle);
  ASSERT_TRUE(result.usable);
  EXPECT_EQ(apply_bundle(atlas(), bundle, result), 0);
  for (std::uint32_t k = 0; k < 6; ++k) {
    EXPECT_LT(
        test::centre_error(atlas().keyframe(keyframe_id(k)).cam_from_world, mapped.views[k].cam_from_world),
        5e-4);
  }
  for (std::size_t p = 0; p < mapped.landmarks.size(); ++p) {
    if (!mapped.landmarks[p].valid()) continue;
    const Landmark& landmark = atlas().landmark(mapped.landmarks[p]);
    if (landmark.observations.back().keyframe == keyframe_id(0)) continue;  // seen by none that moves
    EXPECT_LT((landmark.position - mapped.scene.points[p].position).norm(), 5e-3);
    const Keyframe& first = atlas().keyframe(landmark.observations.front().keyframe);
    EXPECT_NEAR(landmark.max_distance,
                (landmark.position - first.cam_from_world.centre()).norm() *
                    first.features->scale_of(landmark.observations.front().keypoint),
                1e-5)
        << "distances are those of the new places";
  }
  test::expect_consistent(atlas());
}

TEST_F(MapBundles, FixedKeyframesStay) {
  MapBundle bundle =
      make_map_bundle(atlas(), {keyframe_id(3), keyframe_id(4)}, {keyframe_id(2), keyframe_id(5)});
  BundleResult result = adjust(bundle);
  const Pose fixed = atlas().keyframe(keyframe_id(5)).cam_from_world;
  bundle.problem.cam_from_world[3] = Pose();  // whatever is said of them
  apply_bundle(atlas(), bundle, result);
  EXPECT_EQ(atlas().keyframe(keyframe_id(5)).cam_from_world.translation, fixed.translation);
}

TEST_F(MapBundles, OutliersAreForgotten) {
  const Keyframe& keyframe = atlas().keyframe(keyframe_id(3));
  const int wrong = static_cast<int>(
      std::find_if(keyframe.landmarks.begin(), keyframe.landmarks.end(),
                   [&](LandmarkId l) { return atlas().landmark(l).observations.size() >= 4; }) -
      keyframe.landmarks.begin());
  const LandmarkId landmark = keyframe.landmarks[wrong];
  const std::size_t observations = atlas().landmark(landmark).observations.size();
  Measurement measurement = keyframe.measurements[wrong];
  measurement.pixel.x() += 40;
  atlas().set_measurement(keyframe_id(3), wrong, measurement);
  MapBundle bundle = make_map_bundle(
      atlas(), {keyframe_id(1), keyframe_id(2), keyframe_id(3), keyframe_id(4), keyframe_id(5)},
      {keyframe_id(0)});
  const BundleResult result = adjust(bundle);
  ASSERT_TRUE(result.usable);
  EXPECT_EQ(apply_bundle(atlas(), bundle, result), 1);
  EXPECT_FALSE(atlas().keyframe(keyframe_id(3)).landmarks[wrong].valid());
  EXPECT_EQ(atlas().landmark(landmark).observations.size(), observations - 1);
  test::expect_consistent(atlas());
}

TEST_F(MapBundles, ALandmarkOfOutliersOnlyGoes) {
  const MapBundle bundle = make_map_bundle(atlas(), {keyframe_id(1), keyframe_id(2)}, {});
  BundleResult result;
  result.usable = true;
  result.inlier.assign(bundle.problem.observations.size(), 1);
  std::vector<LandmarkId> gone;
  int outliers = 0;
  for (std::size_t point = 0; point < bundle.landmarks.size(); point += 7)
    gone.push_back(bundle.landmarks[point]);
  for (const LandmarkId landmark : gone) {
    // Others see it too: their observations are not part of the problem and must go first.
    for (const std::uint32_t k : {0U, 3U, 4U, 5U}) {
      const int keypoint = atlas().keypoint_of(landmark, keyframe_id(k));
      if (keypoint >= 0) atlas().remove_observation(keyframe_id(k), keypoint);
    }
  }
  for (std::size_t i = 0; i < result.inlier.size(); ++i) {
    if (bundle.problem.observations[i].point % 7 != 0) continue;
    result.inlier[i] = 0;
    ++outliers;
  }
  EXPECT_EQ(apply_bundle(atlas(), bundle, result), outliers);
  for (const LandmarkId landmark : gone) EXPECT_FALSE(atlas().has(landmark));
  test::expect_consistent(atlas());
}

TEST_F(MapBundles, AnUnusableResultChangesNothing) {
  MapBundle bundle = make_map_bundle(atlas(), {keyframe_id(1), keyframe_id(2)}, {keyframe_id(0)});
  const int landmarks = atlas().landmark_count();
  const Pose before = atlas().keyframe(keyframe_id(1)).cam_from_world;
  bundle.problem.cam_from_world[0] = test::camera_at(9, 9, 9);
  BundleResult result;
  result.inlier.assign(bundle.problem.observations.size(), 0);
  EXPECT_EQ(apply_bundle(atlas(), bundle, result), 0);
  EXPECT_EQ(atlas().landmark_count(), landmarks);
  EXPECT_EQ(atlas().keyframe(keyframe_id(1)).cam_from_world.translation, before.translation);
  test::expect_consistent(atlas());
}

}  // namespace
}  // namespace stdc
