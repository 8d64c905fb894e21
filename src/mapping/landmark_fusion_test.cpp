#include "mapping/landmark_fusion.hpp"

#include <gtest/gtest.h>

#include "mapping/test_keyframes.hpp"

namespace stdc {
namespace {

/// Three keyframes that share the landmarks of the points 0, 2, 4, ...
struct ThreeViews {
  test::MappedScene mapped{test::Scene(400)};
  NoiseSettings noise;
  MappingSettings settings;

  ThreeViews() {
    for (int k = 0; k < 3; ++k) {
      test::ViewOptions options;
      options.pixel_noise = 0.3;
      options.seed = 5 + k;
      test::add_some(mapped, mapped.scene.look(test::camera_at(0.15 * k, 0.03 * k, 0), options),
                     [](int point) { return point % 2 == 0; });
    }
  }
  Atlas& atlas() { return mapped.atlas; }
  /// Points 1, 3, 5, ... that both keyframes see.
  std::vector<int> free_in(int a, int b) const {
    std::vector<int> points;
    for (const int point : mapped.views[a].points) {
      if (point % 2 != 0 && mapped.views[b].keypoint_of(point) >= 0) points.push_back(point);
    }
    return points;
  }
  /// A landmark of a point, beside its true place [m], that one keyframe sees.
  LandmarkId add_landmark(int point, int keyframe, const Eigen::Vector3d& beside = Eigen::Vector3d::Zero()) {
    const KeyframeId id{static_cast<std::uint32_t>(keyframe)};
    const LandmarkId landmark = atlas().add_landmark(mapped.scene.points[point].position + beside, id);
    EXPECT_TRUE(atlas().observe(id, mapped.views[keyframe].keypoint_of(point), landmark));
    atlas().refresh(landmark);
    return landmark;
  }
  LandmarkId landmark_at(int point, int keyframe) {
    return atlas()
        .keyframe({static_cast<std::uint32_t>(keyframe)})
        .landmarks[mapped.views[keyframe].keypoint_of(point)];
  }
  int fuse(int keyframe) {
    return fuse_landmarks(atlas(), {static_cast<std::uint32_t>(keyframe)}, {mapped.scene.camera, noise},
                          settings);
  }
};

TEST(LandmarkFusion, MergesDuplicates) {
  ThreeViews scene;
  const std::vector<int> points = scene.free_in(1, 2);
  ASSERT_GT(points.size(), 40U);
  for (const int point : points) {
    scene.add_landmark(point, 1, {0.002, 0, 0});
    scene.add_landmark(point, 2, {0, -0.002, 0.003});
  }
  EXPECT_GT(scene.fuse(2), 0.9 * static_cast<double>(points.size()));
  test::expect_consistent(scene.atlas());
  int one = 0;
  for (const int point : points) one += scene.landmark_at(point, 1) == scene.landmark_at(point, 2) ? 1 : 0;
  EXPECT_GT(one, 0.95 * static_cast<double>(points.size()));
  for (const LandmarkId id : scene.atlas().landmark_ids())
    EXPECT_TRUE(test::is_pure(scene.mapped, scene.atlas().landmark(id)));
}

TEST(LandmarkFusion, AddsMissingObservationsBothWays) {
  ThreeViews scene;
  const std::vector<int> points = scene.free_in(0, 2);
  const std::size_t half = points.size() / 2;
  for (std::size_t i = 0; i < points.size(); ++i) scene.add_landmark(points[i], i < half ? 0 : 2);
  scene.fuse(2);
  test::expect_consistent(scene.atlas());
  int seen_by_both = 0;
  for (const int point : points) {
    const LandmarkId id = scene.landmark_at(point, 0);
    seen_by_both += id.valid() && id == scene.landmark_at(point, 2) ? 1 : 0;
  }
  EXPECT_GT(seen_by_both, 0.9 * static_cast<double>(points.size()));
}

TEST(LandmarkFusion, TheBetterFoundedOneStays) {
  ThreeViews scene;
  std::vector<int> points = scene.free_in(0, 2);
  std::erase_if(points, [&](int p) { return scene.mapped.views[1].keypoint_of(p) < 0; });
  std::vector<LandmarkId> founded, young;
  for (const int point : points) {
    founded.push_back(scene.add_landmark(point, 0));
    scene.atlas().observe({1}, scene.mapped.views[1].keypoint_of(point), founded.back());
    scene.atlas().refresh(founded.back());
    young.push_back(scene.add_landmark(point, 2));
    scene.atlas().count_visible(young.back(), 3);
    scene.atlas().count_found(young.back(), 2);
  }
  scene.fuse(2);
  int merged = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_TRUE(scene.atlas().has(founded[i]));
    if (scene.atlas().has(young[i])) continue;
    ++merged;
    EXPECT_EQ(scene.atlas().landmark(founded[i]).observations.size(), 3U);
    EXPECT_EQ(scene.atlas().landmark(founded[i]).visible, 3) << "the counts are added";
    EXPECT_EQ(scene.atlas().landmark(founded[i]).found, 2);
  }
  EXPECT_GT(merged, 0.9 * static_cast<double>(points.size()));
}

TEST(LandmarkFusion, LeavesApartWhatIsNotTheSame) {
  ThreeViews scene;
  const std::vector<int> points = scene.free_in(0, 2);
  for (const int point : points) {
    scene.add_landmark(point, 0, {0, 0.1, 0});  // 17 px beside
    scene.add_landmark(point, 2, {0, -0.1, 0});
  }
  scene.fuse(2);
  test::expect_consistent(scene.atlas());
  for (const int point : points) {
    EXPECT_TRUE(scene.landmark_at(point, 0).valid() && scene.landmark_at(point, 2).valid());
    EXPECT_NE(scene.landmark_at(point, 0), scene.landmark_at(point, 2));
  }
}

TEST(LandmarkFusion, ADepthThatDisagreesForbidsIt) {
  // Along the ray of the keyframe that looks for them the pixel fits, but the measured depth does not.
  ThreeViews scene;
  const std::vector<int> points = scene.free_in(0, 2);
  const Eigen::Vector3d centre = scene.atlas().keyframe({2}).cam_from_world.centre();
  for (const int point : points)
    scene.add_landmark(point, 0, 0.2 * (scene.mapped.scene.points[point].position - centre));
  scene.fuse(2);
  int observed = 0, with_depth = 0;
  for (const int point : points) {
    if (scene.mapped.views[2].features->depth(scene.mapped.views[2].keypoint_of(point)) <= 0) continue;
    ++with_depth;
    observed += scene.landmark_at(point, 2).valid() ? 1 : 0;
  }
  EXPECT_GT(with_depth, 30);
  EXPECT_EQ(observed, 0);
}

TEST(LandmarkFusion, CovisibilityIsUpToDateAfterwards) {
  ThreeViews scene;
  const auto shared = [&] { return scene.atlas().keyframe({2}).covisible.front().shared; };
  const int before = shared();
  for (const int point : scene.free_in(1, 2)) scene.add_landmark(point, 1);
  const int fused = scene.fuse(2);
  EXPECT_GT(fused, 40);
  EXPECT_EQ(scene.atlas().keyframe({2}).covisible.front().keyframe, KeyframeId{1});
  EXPECT_GT(shared(), before + 40);
  EXPECT_GT(scene.fuse(2), 40) << "what it sees now it shows to the first keyframe";
  EXPECT_EQ(scene.fuse(2), 0) << "nothing is left to do";
}

}  // namespace
}  // namespace stdc
