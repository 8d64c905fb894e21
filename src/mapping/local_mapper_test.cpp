#include "mapping/local_mapper.hpp"

#include <gtest/gtest.h>

#include "core/test_bytes.hpp"
#include "mapping/test_keyframes.hpp"

namespace stdc {
namespace {

/// Maps a camera that goes to and fro before the room, from poses that are off by millimetres. A tracker's
/// part is played by the truth: a keyframe sees the landmarks that its points have in the map, and makes new
/// ones of the depths of most others.
class Walk {
 public:
  explicit Walk(int keyframes, double pose_error = 0.004) : mapped(test::Scene(350)) {
    noise.pixel_sigma = 0.6;
    noise.inverse_depth_sigma = 0.005;
    mapper.emplace(SensorModel{mapped.scene.camera, noise}, MappingSettings(), BundleSettings(), 3.2);
    Random random(3);
    for (int k = 0; k < keyframes; ++k) step(k, k == 0 ? 0 : pose_error, random);
  }

  test::MappedScene mapped;
  std::vector<MappingReport> outcomes;
  int total(int MappingReport::*member) const {
    int sum = 0;
    for (const MappingReport& outcome : outcomes) sum += outcome.*member;
    return sum;
  }

 private:
  static Pose path(int k) {
    const double way = 1.1 * std::sin(0.35 * k);
    return test::camera_at(way, 0.1 * std::sin(0.9 * k), 0.1 * (1 - std::cos(0.5 * k)), 0, -0.15 * way);
  }
  void step(int k, double pose_error, Random& random) {
    test::ViewOptions options;
    options.pixel_noise = 0.2;
    options.depth_noise = 0.0015;
    options.seed = 1000 + k;
    const test::View view = mapped.scene.look(path(k), options);
    const KeyframeId id = mapped.add_bare(view);
    Vector6d twist;
    for (double& x : twist) x = pose_error * random.normal();
    twist.tail<3>() *= 0.5;
    mapped.atlas.set_pose(id, Pose::exp(twist) * view.cam_from_world);
    for (int i = 0; i < view.features->size(); ++i) track_or_make(id, i);
    outcomes.push_back(mapper->process(mapped.atlas, id));
  }
  void track_or_make(KeyframeId id, int keypoint) {
    const test::View& view = mapped.views[id.value];
    const int point = view.points[keypoint];
    LandmarkId& landmark = mapped.landmarks[point];
    if (landmark.valid() && mapped.atlas.has(landmark)) {
      mapped.atlas.count_visible(landmark, 1);
      mapped.atlas.count_found(landmark, 1);
      if (mapped.atlas.observe(id, keypoint, landmark)) return;
    }
    if (point % 3 == 0 || view.features->depth(keypoint) <= 0) return;  // left to the mapper
    if (mapped.atlas.keyframe(id).landmarks[keypoint].valid()) return;
    const Measurement& m = mapped.atlas.keyframe(id).measurements[keypoint];
    landmark = mapped.atlas.add_landmark(mapped.atlas.keyframe(id).cam_from_world.inverse() *
                                             mapped.scene.camera.unproject(m.pixel.cast<double>(), m.depth),
                                         id);
    mapped.atlas.observe(id, keypoint, landmark);
    mapped.atlas.refresh(landmark);
  }

  NoiseSettings noise;
  std::optional<LocalMapper> mapper;
};

TEST(LocalMapper, MapsAWalkToAndFro) {
  const Walk walk(24);
  const Atlas& atlas = walk.mapped.atlas;
  test::expect_consistent(atlas);
  for (const KeyframeId id : atlas.keyframe_ids()) {
    const Keyframe& keyframe = atlas.keyframe(id);
    EXPECT_LT(test::centre_error(keyframe.cam_from_world, walk.mapped.views[id.value].cam_from_world), 0.01);
    EXPECT_TRUE(id.value == 0 || (keyframe.parent < id && atlas.has(keyframe.parent)));
  }
  EXPECT_GT(walk.total(&MappingReport::triangulated), 40);
  EXPECT_GT(walk.total(&MappingReport::fused), 40);
  EXPECT_GT(walk.total(&MappingReport::culled_keyframes), 3) << "it sees the same again and again";
  EXPECT_EQ(atlas.keyframe_count() + walk.total(&MappingReport::culled_keyframes), 24);
  int mixed = 0;
  std::vector<int> landmarks_of_point(walk.mapped.scene.points.size(), 0);
  for (const LandmarkId id : atlas.landmark_ids()) {
    mixed += test::is_pure(walk.mapped, atlas.landmark(id)) ? 0 : 1;
    ++landmarks_of_point[test::point_seen(walk.mapped, atlas.landmark(id).observations.front())];
  }
  EXPECT_LE(mixed, atlas.landmark_count() / 100);
  const auto doubled =
      std::count_if(landmarks_of_point.begin(), landmarks_of_point.end(), [](int n) { return n > 1; });
  EXPECT_LT(static_cast<double>(doubled), 0.1 * atlas.landmark_count()) << "duplicates are fused";
}

TEST(LocalMapper, TheFirstKeyframeIsMappedAlone) {
  const Walk walk(1);
  EXPECT_EQ(walk.outcomes[0].triangulated, 0);
  EXPECT_EQ(walk.outcomes[0].fused, 0);
  EXPECT_EQ(walk.outcomes[0].bundle.keyframes, 1);
  EXPECT_LT(
      test::centre_error(walk.mapped.atlas.keyframe({0}).cam_from_world, walk.mapped.views[0].cam_from_world),
      1e-12);
  test::expect_consistent(walk.mapped.atlas);
}

TEST(LocalMapper, UnseenLandmarksAreCulledAfterTheirProbation) {
  // Noise that the first keyframes put into the map and nobody sees again.
  Walk walk(1);
  test::MappedScene& mapped = walk.mapped;
  LocalMapper mapper({mapped.scene.camera, {}}, {}, {}, 3.2);
  const test::Scene phantoms(200, false, 55);
  test::MappedScene alone(phantoms);
  alone.add(phantoms.look(Pose()));
  mapper.process(alone.atlas, {0});
  const int before = alone.atlas.landmark_count();
  for (int k = 1; k < 4; ++k) {
    alone.add_bare(mapped.scene.look(test::camera_at(0.05 * k, 0, 0)));
    mapper.process(alone.atlas, {static_cast<std::uint32_t>(k)});
    test::expect_consistent(alone.atlas);
  }
  EXPECT_GT(before, 80);
  for (const LandmarkId id : alone.atlas.landmark_ids()) EXPECT_GE(static_cast<int>(id.value), before);
}

TEST(LocalMapper, GivesTheSameBytesTwice) {
  const Walk a(10), b(10);
  ASSERT_EQ(a.mapped.atlas.keyframe_ids(), b.mapped.atlas.keyframe_ids());
  ASSERT_EQ(a.mapped.atlas.landmark_ids(), b.mapped.atlas.landmark_ids());
  for (const LandmarkId id : a.mapped.atlas.landmark_ids()) {
    const Eigen::Vector3d &p = a.mapped.atlas.landmark(id).position,
                          &q = b.mapped.atlas.landmark(id).position;
    EXPECT_TRUE(test::same_bytes(p, q));
  }
}

}  // namespace
}  // namespace stdc
