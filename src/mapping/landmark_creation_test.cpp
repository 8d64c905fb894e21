#include "mapping/landmark_creation.hpp"

#include <gtest/gtest.h>

#include "mapping/test_keyframes.hpp"

namespace stdc {
namespace {

/// Two keyframes that share the landmarks of every third point; the others have none yet.
struct TwoViews {
  test::MappedScene mapped;
  NoiseSettings noise;
  MappingSettings settings;
  int common = 0;  ///< points without landmark that both see

  explicit TwoViews(const Pose& second, test::ViewOptions options, int points = 400)
      : mapped(test::Scene(points)) {
    const auto every_third = [](int point) { return point % 3 == 0; };
    test::add_some(mapped, mapped.scene.look(Pose(), options), every_third);
    options.seed += 1;
    test::add_some(mapped, mapped.scene.look(second, options), every_third);
    for (const int point : mapped.views[0].points)
      common += point % 3 != 0 && mapped.views[1].keypoint_of(point) >= 0 ? 1 : 0;
  }
  int create() { return create_landmarks(mapped.atlas, {1}, {mapped.scene.camera, noise}, settings); }
  /// Distances of the new landmarks from their points [m], sorted.
  std::vector<double> errors() const {
    std::vector<double> errors;
    for (const LandmarkId id : mapped.atlas.landmark_ids()) {
      const Landmark& landmark = mapped.atlas.landmark(id);
      const int point = test::point_seen(mapped, landmark.observations.front());
      if (point % 3 == 0) continue;
      errors.push_back((landmark.position - mapped.scene.points[point].position).norm());
    }
    std::sort(errors.begin(), errors.end());
    return errors;
  }
};

test::ViewOptions noisy(bool depth) {
  test::ViewOptions options;
  options.pixel_noise = 0.4;
  options.depth_noise = 0.003;
  options.depth = depth;
  return options;
}

TEST(LandmarkCreation, TriangulatesWhereThereIsNoDepth) {
  TwoViews scene(test::camera_at(0.4, 0.05, 0.05, 0.02, -0.05, 0.05), noisy(false));
  ASSERT_GT(scene.common, 80);
  const int before = scene.mapped.atlas.landmark_count();
  const int created = scene.create();
  EXPECT_GT(created, 0.75 * scene.common);
  EXPECT_EQ(scene.mapped.atlas.landmark_count(), before + created);
  test::expect_consistent(scene.mapped.atlas);
  int mixed = 0;
  for (const LandmarkId id : scene.mapped.atlas.landmark_ids()) {
    const Landmark& landmark = scene.mapped.atlas.landmark(id);
    mixed += test::is_pure(scene.mapped, landmark) ? 0 : 1;
    if (static_cast<int>(id.value) < before) continue;
    EXPECT_EQ(landmark.created_by, KeyframeId{1});
    EXPECT_EQ(landmark.observations.size(), 2U);
    EXPECT_GT(landmark.max_distance, 0);
    const Observation& oldest = landmark.observations.front();
    const Keyframe& anchor = scene.mapped.atlas.keyframe(oldest.keyframe);
    EXPECT_FLOAT_EQ(anchor.measurements[oldest.keypoint].scale,
                    0.5F * anchor.features->scale_of(oldest.keypoint));
  }
  EXPECT_EQ(mixed, 0);
  // sigma_z = z^2 sqrt(2) sigma scale / (f b) = 0.04 m on the wall at a scale of 1.7
  const auto errors = scene.errors();
  EXPECT_LT(errors[errors.size() / 2], 0.03);
  EXPECT_LT(errors[errors.size() * 95 / 100], 0.12);
}

TEST(LandmarkCreation, NeedsParallaxWhereThereIsNoDepth) {
  TwoViews scene(test::camera_at(0.04, 0, 0), noisy(false));
  ASSERT_GT(scene.common, 80);
  EXPECT_LT(scene.create(), 0.05 * scene.common) << "0.04 m at 3 m are less than 1.5 degrees";
  scene.settings.min_parallax = 0.3;
  EXPECT_GT(scene.create(), 0.5 * scene.common);
}

TEST(LandmarkCreation, TakesTheDepthWhereTheRaysAreParallel) {
  TwoViews scene(test::camera_at(0.04, 0, 0), noisy(true));
  const int created = scene.create();
  EXPECT_GT(created, 0.75 * scene.common);
  const auto errors = scene.errors();
  EXPECT_LT(errors[errors.size() / 2], 0.025) << "sigma_z = 0.003 z^2";
}

TEST(LandmarkCreation, RefusesPointsWhoseDepthDisagrees) {
  test::ViewOptions options = noisy(true);
  options.depth_noise = 0.2;
  TwoViews scene(test::camera_at(0.4, 0, 0), options);
  EXPECT_LT(scene.create(), 0.05 * scene.common);
}

TEST(LandmarkCreation, SaysNothingWithoutABaseline) {
  TwoViews scene(test::camera_at(0.01, 0, 0, 0, 0.1), noisy(true));
  EXPECT_EQ(scene.create(), 0);
}

TEST(LandmarkCreation, WorksThroughARollingShutter) {
  test::MappedScene mapped(test::Scene(400));
  mapped.scene.camera.readout_time = 0.03;
  const auto every_third = [](int point) { return point % 3 == 0; };
  test::ViewOptions options = noisy(true);
  options.pixel_noise = 0.2;
  options.twist << 0.3, 0.1, 0.1, 0.3, -0.4, 0.4;
  test::add_some(mapped, mapped.scene.look(Pose(), options), every_third);
  options.twist = -options.twist;
  options.seed = 2;
  test::add_some(mapped, mapped.scene.look(test::camera_at(0.4, 0, 0), options), every_third);
  const int before = mapped.atlas.landmark_count();
  EXPECT_GT(create_landmarks(mapped.atlas, {1}, {mapped.scene.camera, {}}, {}), 60);
  for (const LandmarkId id : mapped.atlas.landmark_ids()) {
    if (static_cast<int>(id.value) < before) continue;
    const Landmark& landmark = mapped.atlas.landmark(id);
    const int point = test::point_seen(mapped, landmark.observations.front());
    EXPECT_LT((landmark.position - mapped.scene.points[point].position).norm(), 0.15);
  }
}

TEST(LandmarkCreation, ASecondCallFindsNothingNew) {
  TwoViews scene(test::camera_at(0.4, 0, 0), noisy(false));
  const int created = scene.create();
  EXPECT_LT(scene.create(), 0.05 * created);
  test::expect_consistent(scene.mapped.atlas);
}

}  // namespace
}  // namespace stdc
