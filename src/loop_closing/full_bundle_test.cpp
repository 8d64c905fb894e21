#include "loop_closing/full_bundle.hpp"

#include <gtest/gtest.h>

#include "atlas/test_scene.hpp"
#include "core/random.hpp"

namespace stdc {
namespace {

using test::camera_at;
using test::centre_error;
using test::MappedScene;
using test::Scene;

Pose place(int k) { return camera_at(0.1 * k, 0.02 * k, 0.03 * k, 0.01 * k, -0.02 * k); }

test::ViewOptions options(int k) {
  test::ViewOptions options;
  options.depth_noise = 0.002;
  options.pixel_noise = 0.3;
  options.seed = static_cast<std::uint64_t>(k) + 1;
  return options;
}

MappedScene mapped_scene(int keyframes) {
  MappedScene mapped{Scene(400)};
  for (int k = 0; k < keyframes; ++k) mapped.add(mapped.scene.look(place(k), options(k)));
  return mapped;
}

/// Moves all but the first keyframe off their places.
void shake(Atlas& atlas) {
  Random random(4);
  for (const KeyframeId id : atlas.keyframe_ids()) {
    if (!atlas.keyframe(id).parent.valid()) continue;
    Vector6d twist;
    for (double& value : twist) value = 0.02 * random.normal();
    atlas.set_pose(id, Pose::exp(twist) * atlas.keyframe(id).cam_from_world);
  }
}

double worst_error(const Atlas& atlas) {
  double worst = 0;
  for (const KeyframeId id : atlas.keyframe_ids()) {
    worst =
        std::max(worst, centre_error(atlas.keyframe(id).cam_from_world, place(static_cast<int>(id.value))));
  }
  return worst;
}

TEST(FullBundle, MendsAWholeMap) {
  MappedScene mapped = mapped_scene(8);
  shake(mapped.atlas);
  ASSERT_GT(worst_error(mapped.atlas), 0.03);
  FullBundle bundle(mapped.atlas, {0});
  EXPECT_EQ(bundle.keyframes(), 8);
  bundle.solve({mapped.scene.camera, {}}, {});
  EXPECT_TRUE(bundle.apply(mapped.atlas));
  EXPECT_LT(worst_error(mapped.atlas), 0.006);
  EXPECT_EQ(mapped.atlas.keyframe({0}).cam_from_world.translation, place(0).translation) << "the world stays";
}

TEST(FullBundle, WhatCameInTheMeantimeMovesAlong) {
  MappedScene mapped = mapped_scene(6);
  shake(mapped.atlas);
  FullBundle bundle(mapped.atlas, {0});
  bundle.solve({mapped.scene.camera, {}}, {});
  // A keyframe that was placed relative to its shaken parent, with a landmark of its own.
  const test::View view = mapped.scene.look(place(6), options(6));
  const Pose off = place(5).inverse() * mapped.atlas.keyframe({5}).cam_from_world;
  const KeyframeId young = mapped.add(view);
  mapped.atlas.set_pose(young, view.cam_from_world * off);
  const KeyframeId parent = mapped.atlas.keyframe(young).parent;
  const Pose young_from_parent =
      mapped.atlas.keyframe(young).cam_from_world * mapped.atlas.keyframe(parent).cam_from_world.inverse();
  LandmarkId own;
  for (const LandmarkId id : mapped.atlas.keyframe(young).landmarks) {
    if (id.valid() && mapped.atlas.landmark(id).created_by == young) own = id;
  }
  ASSERT_TRUE(own.valid());
  const Eigen::Vector3d in_young =
      mapped.atlas.keyframe(young).cam_from_world * mapped.atlas.landmark(own).position;
  ASSERT_TRUE(bundle.apply(mapped.atlas));
  const Keyframe& keyframe = mapped.atlas.keyframe(young);
  const Pose now = keyframe.cam_from_world * mapped.atlas.keyframe(parent).cam_from_world.inverse();
  EXPECT_LT(centre_error(now, young_from_parent), 1e-9);
  EXPECT_LT((keyframe.cam_from_world * mapped.atlas.landmark(own).position - in_young).norm(), 1e-9);
}

TEST(FullBundle, WhatHasGoneInTheMeantimeIsPassedOver) {
  MappedScene mapped = mapped_scene(6);
  shake(mapped.atlas);
  FullBundle bundle(mapped.atlas, {0});
  bundle.solve({mapped.scene.camera, {}}, {});
  mapped.atlas.remove(KeyframeId{3});
  mapped.atlas.remove(mapped.atlas.landmark_ids()[5]);
  EXPECT_TRUE(bundle.apply(mapped.atlas));
  EXPECT_FALSE(mapped.atlas.has(KeyframeId{3}));
  EXPECT_LT(worst_error(mapped.atlas), 0.006);
}

TEST(FullBundle, LeavesOtherMapsAlone) {
  MappedScene mapped = mapped_scene(4);
  mapped.start_map();
  for (int k = 4; k < 8; ++k) mapped.add(mapped.scene.look(place(k), options(k)));
  const Pose before = mapped.atlas.keyframe({5}).cam_from_world;
  shake(mapped.atlas);
  mapped.atlas.set_pose({5}, before);
  FullBundle bundle(mapped.atlas, {0});
  EXPECT_EQ(bundle.keyframes(), 4);
  bundle.solve({mapped.scene.camera, {}}, {});
  EXPECT_TRUE(bundle.apply(mapped.atlas));
  EXPECT_EQ(mapped.atlas.keyframe({5}).cam_from_world.translation, before.translation);
}

TEST(FullBundle, AnUnusableSolutionChangesNothing) {
  Atlas atlas;
  FullBundle bundle(atlas, {0});
  bundle.solve({Camera(), {}}, {});
  EXPECT_FALSE(bundle.apply(atlas));
}

}  // namespace
}  // namespace stdc
