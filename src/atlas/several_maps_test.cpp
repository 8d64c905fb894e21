// Several maps in one.
#include <gtest/gtest.h>

#include "atlas/test_scene.hpp"

namespace stdc {
namespace {

using test::camera_at;
using test::MappedScene;
using test::Scene;

/// Two maps of one room, each in three keyframes: 0, 1, 2 and 3, 4, 5.
struct TwoMaps : MappedScene {
  explicit TwoMaps(int points = 150) : MappedScene(Scene(points)) {
    for (int k = 0; k < 6; ++k) {
      if (k == 3) start_map();
      add(scene.look(camera_at(0.05 * k, 0, 0)));
    }
  }
};

constexpr KeyframeId id(std::uint32_t value) { return {value}; }

TEST(Atlas, MapsOfOneRoomShareNothing) {
  const TwoMaps two;
  const Atlas& atlas = two.atlas;
  EXPECT_EQ(atlas.map_count(), 2);
  EXPECT_EQ(atlas.root({0}), id(0));
  EXPECT_EQ(atlas.root({1}), id(3));
  EXPECT_EQ(atlas.keyframe_ids({1}), (std::vector{id(3), id(4), id(5)}));
  EXPECT_EQ(atlas.keyframe_count({0}), 3);
  EXPECT_FALSE(atlas.keyframe(id(3)).parent.valid()) << "though there are older keyframes";
  test::expect_consistent(atlas);
}

TEST(Atlas, NumbersAreGivenInTheOrderOfTheMaps) {
  EXPECT_EQ(Atlas().map_count(), 0);
  TwoMaps two;
  two.start_map();
  EXPECT_EQ(two.map, MapId{2});
  two.add(two.scene.look(Pose()));
  EXPECT_EQ(two.atlas.root({2}), id(6));
  two.atlas.join({2}, {1});
  EXPECT_EQ(two.atlas.map_count(), 3);
  two.start_map();
  EXPECT_EQ(two.map, MapId{3}) << "a number is never given again";
  two.add(two.scene.look(Pose()));
  EXPECT_EQ(two.atlas.map_of(id(7)), MapId{3});
  test::expect_consistent(two.atlas);
}

TEST(Atlas, AParentIsNeverOfAnotherMap) {
  TwoMaps two;
  // The newest keyframe of the older map sees nothing that any other sees, and the one before it is of the
  // other atlas.
  two.map = {0};
  const KeyframeId alone = two.add_bare(two.scene.look(camera_at(0.4, 0, 0)));
  two.atlas.update_covisibility(alone);
  EXPECT_EQ(two.atlas.keyframe(alone).parent, id(2));
  test::expect_consistent(two.atlas);
  two.atlas.remove(id(2));
  EXPECT_EQ(two.atlas.keyframe(alone).parent, id(0)) << "that of its parent";
  test::expect_consistent(two.atlas);
}

TEST(Atlas, NoRootCanBeRemoved) {
  TwoMaps two;
  two.atlas.remove(id(0));
  two.atlas.remove(id(3));
  EXPECT_TRUE(two.atlas.has(id(0)) && two.atlas.has(id(3)));
  EXPECT_EQ(two.atlas.keyframe_count(), 6);
  two.atlas.remove(id(4));
  EXPECT_EQ(two.atlas.keyframe_count({1}), 2);
  test::expect_consistent(two.atlas);
}

TEST(Atlas, JoinedMapsAreOneTree) {
  TwoMaps two;
  Atlas& atlas = two.atlas;
  atlas.remove(id(4));
  EXPECT_EQ(atlas.map_of(id(4)), MapId{1}) << "it is remembered whose it was";
  const Pose before = atlas.keyframe(id(5)).cam_from_world;
  atlas.join({1}, {0});
  EXPECT_EQ(atlas.map_count(), 2);
  EXPECT_FALSE(atlas.root({1}).valid());
  EXPECT_EQ(atlas.root({0}), id(0));
  EXPECT_EQ(atlas.keyframe_count({0}), 5);
  EXPECT_EQ(atlas.keyframe_count({1}), 0);
  EXPECT_TRUE(atlas.keyframe_ids({1}).empty());
  EXPECT_EQ(atlas.keyframe(id(3)).parent, id(0));
  EXPECT_EQ(atlas.map_of(id(4)), MapId{0});
  EXPECT_EQ(atlas.keyframe(id(5)).cam_from_world.translation, before.translation) << "nothing is moved";
  test::expect_consistent(atlas);
}

TEST(Atlas, WhatWasARootIsAKeyframeLikeOthersAfterwards) {
  TwoMaps two;
  Atlas& atlas = two.atlas;
  atlas.join({1}, {0});
  const Pose before = atlas.keyframe(id(3)).cam_from_world;
  atlas.remove(id(3));
  EXPECT_FALSE(atlas.has(id(3)));
  const Atlas::KeptAncestor ancestor = atlas.resolve(id(3));
  EXPECT_EQ(ancestor.keyframe, id(0));
  const Pose after = ancestor.cam_from_ancestor * atlas.keyframe(id(0)).cam_from_world;
  EXPECT_LT(test::centre_error(before, after), 1e-12);
  test::expect_consistent(atlas);
  two.map = {0};
  const KeyframeId next = two.add_bare(two.scene.look(camera_at(0.3, 0, 0)));
  atlas.update_covisibility(next);
  EXPECT_EQ(atlas.keyframe(next).parent, id(5)) << "it follows on those that came by the joining";
  test::expect_consistent(atlas);
}

TEST(Atlas, MapsAreJoinedInAChain) {
  TwoMaps two;
  Atlas& atlas = two.atlas;
  two.start_map();
  for (int k = 0; k < 3; ++k) two.add(two.scene.look(camera_at(0.05 * k, 0, 0)));
  atlas.remove(id(7));
  atlas.join({2}, {1});
  atlas.join({1}, {0});
  EXPECT_EQ(atlas.keyframe_count({0}), 8);
  EXPECT_EQ(atlas.map_of(id(7)), MapId{0});
  EXPECT_EQ(atlas.keyframe(id(6)).parent, id(3));
  EXPECT_FALSE(atlas.root({1}).valid() || atlas.root({2}).valid());
  test::expect_consistent(atlas);
}

TEST(Atlas, TiesStandOnBothSidesAndInOrder) {
  TwoMaps two;
  Atlas& atlas = two.atlas;
  atlas.add_loop_edge(id(1), id(2));
  atlas.add_loop_edge(id(1), id(0));
  atlas.add_loop_edge(id(2), id(1));
  EXPECT_EQ(atlas.keyframe(id(1)).loops, (std::vector{id(0), id(2)}));
  EXPECT_EQ(atlas.keyframe(id(2)).loops, std::vector{id(1)}) << "once only";
  EXPECT_EQ(atlas.keyframe(id(0)).loops, std::vector{id(1)});
  test::expect_consistent(atlas);
  atlas.remove(id(1));
  EXPECT_TRUE(atlas.keyframe(id(0)).loops.empty() && atlas.keyframe(id(2)).loops.empty())
      << "an edge ends with either of its ends";
  test::expect_consistent(atlas);
}

TEST(Atlas, AMapOfWhatAnotherHeldKnowsItsRoots) {
  TwoMaps two;
  two.atlas.add_loop_edge(id(3), id(5));
  std::vector<Keyframe> keyframes;
  std::vector<Landmark> landmarks;
  for (const KeyframeId k : two.atlas.keyframe_ids()) keyframes.push_back(two.atlas.keyframe(k));
  for (const LandmarkId l : two.atlas.landmark_ids()) landmarks.push_back(two.atlas.landmark(l));
  Atlas again(std::move(keyframes), std::move(landmarks));
  EXPECT_EQ(again.map_count(), 2);
  EXPECT_EQ(again.root({1}), id(3));
  test::expect_consistent(again);
  again.remove(id(5));
  EXPECT_TRUE(again.keyframe(id(3)).loops.empty());
  test::expect_consistent(again);
}

/// Keyframes come, are tied and go; maps begin and are joined.
TEST(SeveralMaps, SurviveARandomLife) {
  MappedScene two(Scene(60));
  Atlas& atlas = two.atlas;
  Random random(11);
  const auto one_of = [&](const std::vector<KeyframeId>& ids) {
    return ids[random.below(static_cast<std::uint32_t>(ids.size()))];
  };
  int joined = 0;
  for (int step = 0; step < 120; ++step) {
    if (step % 15 == 14) two.start_map();
    two.add(two.scene.look(camera_at(random.uniform(0, 1), 0, 0)));
    const std::vector<KeyframeId> here = atlas.keyframe_ids(two.map);
    const KeyframeId a = one_of(here), b = one_of(here);
    if (a != b) atlas.add_loop_edge(a, b);
    const std::vector<KeyframeId> all = atlas.keyframe_ids();
    if (all.size() > 14) atlas.remove(one_of(all));
    if (step % 40 == 39) {
      for (MapId into{0}; into < two.map; ++into.value) {
        if (!atlas.root(into).valid()) continue;
        atlas.join(two.map, into);
        two.map = into;
        ++joined;
        break;
      }
    }
    for (LandmarkId& landmark : two.landmarks) {
      if (landmark.valid() && !atlas.has(landmark)) landmark = {};
    }
    test::expect_consistent(atlas);
  }
  EXPECT_EQ(joined, 3);
  for (std::uint32_t k = 0; k < atlas.keyframe_id_limit(); ++k) {
    EXPECT_TRUE(atlas.root(atlas.map_of(id(k))).valid()) << "every frame's map is there";
  }
}

}  // namespace
}  // namespace stdc
