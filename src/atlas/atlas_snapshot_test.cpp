#include "atlas/atlas_snapshot.hpp"

#include <gtest/gtest.h>

#include "atlas/test_scene.hpp"
#include "core/test_bytes.hpp"

namespace stdc {
namespace {

class AtlasSnapshotTest : public ::testing::Test {
 protected:
  AtlasSnapshotTest() : mapped(test::Scene(200)) {
    for (int k = 0; k < 4; ++k) mapped.add(mapped.scene.look(test::camera_at(0.05 * k, 0, 0)));
  }
  test::MappedScene mapped;
};

TEST_F(AtlasSnapshotTest, HoldsWhatTheAtlasHolds) {
  const AtlasSnapshot snapshot(mapped.atlas);
  EXPECT_EQ(snapshot.map_count(), 1);
  EXPECT_EQ(snapshot.keyframe_count(), mapped.atlas.keyframe_count());
  EXPECT_EQ(snapshot.landmark_count(), mapped.atlas.landmark_count());
  for (const KeyframeId id : mapped.atlas.keyframe_ids()) {
    EXPECT_TRUE(snapshot.is_kept(id));
    EXPECT_TRUE(test::same_bytes(snapshot.keyframes()[id.value].cam_from_world,
                                 mapped.atlas.keyframe(id).cam_from_world));
  }
  const auto positions = snapshot.landmark_positions({0});
  const auto ids = mapped.atlas.landmark_ids();
  ASSERT_EQ(positions.size(), ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i)
    EXPECT_EQ(positions[i], mapped.atlas.landmark(ids[i]).position);
  EXPECT_TRUE(snapshot.landmark_positions({1}).empty());
}

TEST_F(AtlasSnapshotTest, StaysAsItIsWhenTheAtlasChanges) {
  const AtlasSnapshot before(mapped.atlas);
  const Pose pose = mapped.atlas.keyframe({1}).cam_from_world;
  mapped.atlas.set_pose({1}, test::camera_at(1, 1, 1));
  mapped.atlas.remove(KeyframeId{2});
  EXPECT_TRUE(test::same_bytes(before.keyframes()[1].cam_from_world, pose));
  EXPECT_EQ(before.keyframe_count(), 4);
}

TEST_F(AtlasSnapshotTest, ARemovedKeyframeFollowsItsAncestor) {
  const Pose cam_from_reference = test::camera_at(0.01, 0.02, 0.03);
  const Pose before = AtlasSnapshot(mapped.atlas).cam_from_world({2}, cam_from_reference);
  mapped.atlas.remove(KeyframeId{2});
  const AtlasSnapshot after(mapped.atlas);
  EXPECT_FALSE(after.is_kept({2}));
  EXPECT_EQ(after.keyframe_count(), 3);
  EXPECT_LT(test::centre_error(after.cam_from_world({2}, cam_from_reference), before), 1e-12);
}

TEST_F(AtlasSnapshotTest, GrowsWithAKeyframe) {
  AtlasSnapshot snapshot(mapped.atlas);
  const std::size_t landmarks = mapped.atlas.landmark_id_limit();
  mapped.start_map();
  const KeyframeId id = mapped.add(mapped.scene.look(test::camera_at(0.3, 0, 0)));
  snapshot.add(mapped.atlas, id, landmarks);
  EXPECT_EQ(snapshot.map_count(), 2);
  EXPECT_EQ(snapshot.keyframe_count(), 5);
  EXPECT_EQ(snapshot.landmark_count(), mapped.atlas.landmark_count());
  EXPECT_FALSE(snapshot.landmark_positions({1}).empty());
}

}  // namespace
}  // namespace stdc
