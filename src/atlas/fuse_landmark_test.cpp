#include "atlas/fuse_landmark.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "atlas/test_scene.hpp"

namespace stdc {
namespace {

constexpr KeyframeId id_of(std::uint32_t value) { return {value}; }

/// Three keyframes of a room and no landmarks.
class Fusing : public ::testing::Test {
 protected:
  Fusing() : mapped(test::Scene(300)) {
    for (int k = 0; k < 3; ++k) {
      test::ViewOptions options;
      options.seed = 5 + k;
      mapped.add_bare(mapped.scene.look(test::camera_at(0.1 * k, 0.02 * k, 0), options));
    }
    for (const int candidate : mapped.views[0].points) {
      if (mapped.views[1].keypoint_of(candidate) < 0 || mapped.views[2].keypoint_of(candidate) < 0) continue;
      const int keypoint = mapped.views[2].keypoint_of(candidate);
      if (mapped.views[2].features->depth(keypoint) > 0) points.push_back(candidate);
    }
  }
  void TearDown() override {
    for (std::uint32_t k = 0; k < 3; ++k) atlas().update_covisibility(id_of(k));
    test::expect_consistent(atlas());
  }
  Atlas& atlas() { return mapped.atlas; }
  int keypoint(int point, std::uint32_t keyframe) const { return mapped.views[keyframe].keypoint_of(point); }
  LandmarkId standing(int point, std::uint32_t keyframe) const {
    return mapped.atlas.keyframe(id_of(keyframe)).landmarks[keypoint(point, keyframe)];
  }
  /// A landmark of a point that some keyframes see, perhaps beside its place [m].
  LandmarkId make(int point, const std::vector<std::uint32_t>& keyframes,
                  const Eigen::Vector3d& beside = Eigen::Vector3d::Zero()) {
    const LandmarkId landmark =
        atlas().add_landmark(mapped.scene.points[point].position + beside, id_of(keyframes.front()));
    for (const std::uint32_t k : keyframes)
      EXPECT_TRUE(atlas().observe(id_of(k), keypoint(point, k), landmark));
    atlas().refresh(landmark);
    return landmark;
  }
  bool fuse(std::uint32_t keyframe, LandmarkId landmark) {
    return fuse_landmark(atlas(), id_of(keyframe), landmark, {mapped.scene.camera, noise}, search);
  }

  test::MappedScene mapped;
  NoiseSettings noise;
  FuseSearch search;
  std::vector<int> points;  ///< that all three see, the third with depth
};

TEST_F(Fusing, AFreeKeypointSeesTheLandmarkFromNowOn) {
  int fused = 0;
  for (const int point : points) {
    const LandmarkId landmark = make(point, {0, 1});
    if (!fuse(2, landmark)) continue;
    ++fused;
    EXPECT_EQ(standing(point, 2), landmark);
    EXPECT_EQ(atlas().landmark(landmark).observations.size(), 3U);
  }
  EXPECT_GT(fused, 0.95 * static_cast<double>(points.size()));
  EXPECT_GT(points.size(), 60U);
}

TEST_F(Fusing, WhatItSeesAlreadyChangesNothing) {
  const LandmarkId landmark = make(points[0], {0, 2});
  EXPECT_FALSE(fuse(2, landmark));
  EXPECT_EQ(atlas().landmark(landmark).observations.size(), 2U);
}

TEST_F(Fusing, OfTwoTheOneThatMoreSeeStays) {
  const LandmarkId founded = make(points[0], {0, 1}), young = make(points[0], {2}, {0.001, 0, 0});
  EXPECT_TRUE(fuse(2, founded));
  EXPECT_TRUE(atlas().has(founded) && !atlas().has(young));
  const LandmarkId often = make(points[1], {1, 2}), rare = make(points[1], {0}, {0, 0.001, 0});
  EXPECT_TRUE(fuse(2, rare));
  EXPECT_TRUE(atlas().has(often) && !atlas().has(rare));
  EXPECT_EQ(atlas().landmark(often).observations.size(), 3U);
}

TEST_F(Fusing, AmongEqualsTheGivenOneStays) {
  const LandmarkId given = make(points[0], {0}), other = make(points[0], {2});
  EXPECT_TRUE(fuse(2, given));
  EXPECT_TRUE(atlas().has(given) && !atlas().has(other));
}

TEST_F(Fusing, TheGivenOneStaysIfThatIsWanted) {
  search.keep_given = true;
  const LandmarkId often = make(points[0], {1, 2}), given = make(points[0], {0});
  atlas().count_visible(often, 7);
  atlas().count_found(often, 5);
  EXPECT_TRUE(fuse(2, given));
  EXPECT_TRUE(atlas().has(given) && !atlas().has(often));
  EXPECT_EQ(standing(points[0], 1), given) << "all that saw the other one see it now";
  EXPECT_EQ(atlas().landmark(given).visible, 7);
  EXPECT_EQ(atlas().landmark(given).found, 5);
}

TEST_F(Fusing, AKeyframeThatSawBothKeepsTheObservationOfTheOneThatStays) {
  const int twin = points[1];
  const LandmarkId stays = make(points[0], {0, 1, 2}), goes = make(twin, {1});
  merge_landmarks(atlas(), goes, stays, {mapped.scene.camera, noise});
  EXPECT_FALSE(atlas().has(goes));
  EXPECT_EQ(atlas().keypoint_of(stays, id_of(1)), keypoint(points[0], 1));
  EXPECT_FALSE(standing(twin, 1).valid());
}

TEST_F(Fusing, NothingChangesWhereItCannotBeTheSame) {
  const auto expect_unseen = [&](int point, const Eigen::Vector3d& beside, const char* why) {
    const LandmarkId landmark = make(point, {0}, beside);
    const LandmarkId other = make(point, {2});
    EXPECT_FALSE(fuse(2, landmark)) << why;
    EXPECT_TRUE(atlas().has(landmark) && atlas().has(other));
  };
  expect_unseen(points[0], {0, 0.1, 0}, "17 px beside");
  expect_unseen(points[1], {0, 0, -20}, "behind the camera");
  expect_unseen(points[2], {50, 0, 0}, "outside of the image");
  const Eigen::Vector3d centre = mapped.views[2].cam_from_world.centre();
  expect_unseen(points[3], 0.2 * (mapped.scene.points[points[3]].position - centre),
                "on the ray, but not at the depth that was measured");
  const double far = std::numeric_limits<double>::quiet_NaN();
  expect_unseen(points[4], {far, far, far}, "nowhere");
}

TEST_F(Fusing, SeenFromBehindOrFromAfarItIsNotLookedFor) {
  const LandmarkId turned = make(points[0], {0});
  // The only observation is from the other side of it.
  const Eigen::Vector3d place = atlas().landmark(turned).position;
  atlas().set_pose(id_of(0), test::camera_at(place.x(), place.y(), place.z() + 2));
  atlas().refresh(turned);
  EXPECT_FALSE(fuse(2, turned));
  const LandmarkId small = make(points[1], {1});
  // A hand's breadth before the camera that knows it: too small to be seen from here.
  const Eigen::Vector3d there = atlas().landmark(small).position;
  atlas().set_pose(id_of(1), test::camera_at(there.x(), there.y(), there.z() - 0.1));
  atlas().refresh(small);
  EXPECT_FALSE(fuse(2, small));
}

TEST_F(Fusing, AnotherDescriptorIsAnotherThing) {
  search.max_hamming_distance = 0;
  int fused = 0;
  for (std::size_t i = 0; i < 20; ++i) fused += fuse(2, make(points[i], {0})) ? 1 : 0;
  EXPECT_EQ(fused, 0) << "each differs by some bits";
}

TEST_F(Fusing, TheRadiusBoundsTheSearch) {
  // 4 mm beside at 3 m: most of a pixel, within the noise.
  const auto count = [&](double radius, std::size_t first) {
    search.radius = radius;
    int fused = 0;
    for (std::size_t i = first; i < first + 20; ++i)
      fused += fuse(2, make(points[i], {0}, {0.004, 0, 0})) ? 1 : 0;
    return fused;
  };
  EXPECT_EQ(count(0.1, 0), 0);
  EXPECT_GT(count(3, 20), 15);
}

TEST_F(Fusing, ObservationsAreAlignedToTheOldest) {
  // With patches: the corner of keyframe 2 lies off by part of a pixel; its observation is moved to where the
  // image looks like the landmark's first one.
  test::MappedScene room(test::Scene(120, true));
  std::vector<Pyramid> pyramids(2);
  for (int k = 0; k < 2; ++k) {
    const Pose pose = test::camera_at(0.02 * k, 0, 0);
    pyramids[k].build(room.scene.render(pose), test::scene_feature_settings());
    test::ViewOptions options;
    options.whole_pixels = true;
    options.pyramid = &pyramids[k];
    options.seed = 5 + k;
    room.add_bare(room.scene.look(pose, options));
  }
  search.radius = 5;
  int fused = 0, moved = 0;
  for (const int point : room.views[0].points) {
    const int there = room.views[1].keypoint_of(point);
    if (there < 0) continue;
    const LandmarkId landmark = room.atlas.add_landmark(room.scene.points[point].position, id_of(0));
    room.atlas.observe(id_of(0), room.views[0].keypoint_of(point), landmark);
    room.atlas.refresh(landmark);
    const Eigen::Vector2f before = room.atlas.keyframe(id_of(1)).measurements[there].seen;
    if (!fuse_landmark(room.atlas, id_of(1), landmark, {room.scene.camera, noise}, search)) continue;
    ++fused;
    moved += room.atlas.keyframe(id_of(1)).measurements[there].seen != before ? 1 : 0;
  }
  EXPECT_GT(fused, 30);
  EXPECT_GT(moved, fused / 2);
  test::expect_consistent(room.atlas);
}

}  // namespace
}  // namespace stdc
