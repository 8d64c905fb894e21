#include "mapping/culling.hpp"

#include <gtest/gtest.h>

#include "mapping/test_keyframes.hpp"

namespace stdc {
namespace {

/// Keyframes at one place; the first landmark-making one is the second of five.
class LandmarkCulling : public ::testing::Test {
 protected:
  LandmarkCulling() : mapped(test::Scene(80)) {
    for (int k = 0; k < 6; ++k) mapped.add_bare(mapped.scene.look(Pose()));
  }
  /// A landmark made by keyframe 1 and seen by so many keyframes, 1 included.
  LandmarkId make(int keyframes) {
    const LandmarkId id = mapped.atlas.add_landmark({0, 0, 3}, {1});
    for (int k = 0; k < keyframes; ++k)
      EXPECT_TRUE(mapped.atlas.observe({static_cast<std::uint32_t>(1 + k)}, next_keypoint, id));
    ++next_keypoint;
    recent.push_back(id);
    return id;
  }
  bool on_probation(LandmarkId id) const {
    return std::find(recent.begin(), recent.end(), id) != recent.end();
  }
  void cull(std::uint32_t current) { cull_landmarks(mapped.atlas, recent, {current}, settings); }

  test::MappedScene mapped;
  std::vector<LandmarkId> recent;
  MappingSettings settings;
  int next_keypoint = 0;
};

TEST_F(LandmarkCulling, RarelyFoundOnesGoAtOnce) {
  const LandmarkId rare = make(3), often = make(3), unseen = make(3);
  mapped.atlas.count_visible(rare, 9);
  mapped.atlas.count_found(rare, 2);
  mapped.atlas.count_visible(often, 8);
  mapped.atlas.count_found(often, 2);
  cull(1);
  EXPECT_FALSE(mapped.atlas.has(rare)) << "2 of 9 are less than a quarter";
  EXPECT_FALSE(on_probation(rare));
  EXPECT_TRUE(mapped.atlas.has(often) && on_probation(often));
  EXPECT_TRUE(mapped.atlas.has(unseen)) << "it never had a chance";
  test::expect_consistent(mapped.atlas);
}

TEST_F(LandmarkCulling, FromTheSecondKeyframeOnItMustHaveBeenSeenOften) {
  const LandmarkId little = make(2), enough = make(3);
  cull(2);
  EXPECT_TRUE(mapped.atlas.has(little)) << "one keyframe later is too early";
  cull(3);
  EXPECT_FALSE(mapped.atlas.has(little));
  EXPECT_TRUE(mapped.atlas.has(enough) && on_probation(enough));
}

TEST_F(LandmarkCulling, ProbationEnds) {
  const LandmarkId id = make(3);
  cull(3);
  EXPECT_TRUE(on_probation(id));
  cull(4);
  EXPECT_FALSE(on_probation(id));
  mapped.atlas.count_visible(id, 100);
  cull(5);
  EXPECT_TRUE(mapped.atlas.has(id)) << "once established it stays";
}

TEST_F(LandmarkCulling, ForgetsThoseThatAreGoneAlready) {
  const LandmarkId gone = make(1), here = make(1);
  mapped.atlas.remove(gone);
  cull(1);
  EXPECT_EQ(recent, std::vector<LandmarkId>{here});
}

/// Five keyframes at nearly the same place. `coarse`: one that sees all at a coarser level than the others.
test::MappedScene crowd(int coarse = -1) {
  test::Scene scene(150);
  for (test::ScenePoint& point : scene.points) point.size_level = 1;
  test::Scene larger = scene;
  for (test::ScenePoint& point : larger.points) point.size_level = 4;
  test::MappedScene mapped(scene);
  for (int k = 0; k < 5; ++k) {
    const test::Scene& seen = coarse >= 0 && k != coarse ? larger : scene;
    mapped.add(seen.look(test::camera_at(0.001 * k, 0, 0)));
  }
  return mapped;
}

TEST(KeyframeCulling, RemovesTheRedundantAndKeepsTheFirst) {
  test::MappedScene mapped = crowd();
  // With the second gone, the third is still seen by three others; then the fourth is seen by two only.
  EXPECT_EQ(cull_keyframes(mapped.atlas, {4}, 10, {}), 2);
  EXPECT_EQ(mapped.atlas.keyframe_count(), 3);
  EXPECT_TRUE(mapped.atlas.has(KeyframeId{0}));
  EXPECT_TRUE(mapped.atlas.has(KeyframeId{4})) << "the one being mapped";
  test::expect_consistent(mapped.atlas);
  EXPECT_EQ(cull_keyframes(mapped.atlas, {4}, 10, {}), 0);
}

TEST(KeyframeCulling, WhatALoopIsTiedToStays) {
  test::MappedScene mapped = crowd();
  mapped.atlas.add_loop_edge({1}, {2});
  EXPECT_EQ(cull_keyframes(mapped.atlas, {4}, 10, {}), 1) << "now the fourth is the redundant one";
  EXPECT_TRUE(mapped.atlas.has(KeyframeId{1}) && mapped.atlas.has(KeyframeId{2}));
  EXPECT_FALSE(mapped.atlas.has(KeyframeId{3}));
  EXPECT_EQ(mapped.atlas.keyframe({1}).loops, std::vector<KeyframeId>{{2}});
  test::expect_consistent(mapped.atlas);
}

TEST(KeyframeCulling, TheRootOfAYoungerMapStays) {
  test::MappedScene mapped = crowd();
  mapped.start_map();
  for (int k = 0; k < 5; ++k) mapped.add(mapped.scene.look(test::camera_at(0.001 * k, 0, 0)));
  EXPECT_EQ(cull_keyframes(mapped.atlas, {9}, 10, {}), 2);
  EXPECT_TRUE(mapped.atlas.has(KeyframeId{5}));
  EXPECT_EQ(mapped.atlas.keyframe_count({0}), 5) << "the other map is not touched";
  test::expect_consistent(mapped.atlas);
}

TEST(KeyframeCulling, OnlyCloseLandmarksCount) {
  test::MappedScene mapped = crowd();
  EXPECT_EQ(cull_keyframes(mapped.atlas, {4}, 0.5, {}), 0) << "none is close";
}

TEST(KeyframeCulling, AFinerViewIsNotRedundant) {
  test::MappedScene mapped = crowd(2);
  cull_keyframes(mapped.atlas, {4}, 10, {});
  EXPECT_TRUE(mapped.atlas.has(KeyframeId{2})) << "the others see it at coarser levels";
  EXPECT_FALSE(mapped.atlas.has(KeyframeId{1}));
}

TEST(KeyframeCulling, WhatIsSeenByItAloneKeepsAKeyframe) {
  test::MappedScene mapped = crowd();
  // A fifth of what each of the covisible ones sees is taken from the others.
  for (std::uint32_t k = 1; k < 4; ++k) {
    const auto seen = mapped.atlas.keyframe({k}).landmarks;
    for (std::size_t i = k; i < seen.size(); i += 5) {
      for (std::uint32_t other = 0; other < 5; ++other) {
        const int keypoint =
            other != k && mapped.atlas.has(seen[i]) ? mapped.atlas.keypoint_of(seen[i], {other}) : -1;
        if (keypoint >= 0) mapped.atlas.remove_observation({other}, keypoint);
      }
    }
  }
  EXPECT_EQ(cull_keyframes(mapped.atlas, {4}, 10, {}), 0);
  MappingSettings lenient;
  lenient.redundant_share = 0.5;
  EXPECT_GT(cull_keyframes(mapped.atlas, {4}, 10, lenient), 0);
}

}  // namespace
}  // namespace stdc
