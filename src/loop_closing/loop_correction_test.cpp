#include "loop_closing/loop_correction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "atlas/map_bundle.hpp"
#include "loop_closing/full_bundle.hpp"
#include "place_recognition/place_recogniser.hpp"
#include "place_recognition/test_revisit.hpp"

namespace stdc {
namespace {

using test::angle_error;
using test::centre_error;
using test::Revisit;
using test::Scene;

LoopTools tools_for(const Revisit& revisit) { return {{revisit.mapped.scene.camera, {}}, {}, {}, {}}; }

LoopReport close(Revisit& revisit, KeyframeId current, KeyframeId matched) {
  const LoopTools tools = tools_for(revisit);
  const auto loop = verify_loop({tools.sensor, {}}, revisit.mapped.atlas, current, matched, {});
  EXPECT_TRUE(loop);
  return close_loop(tools, revisit.mapped.atlas, *loop);
}

/// Both sides of every observation agree, and no landmark is nowhere.
void expect_whole(const Atlas& atlas) {
  for (const KeyframeId id : atlas.keyframe_ids()) {
    const Keyframe& keyframe = atlas.keyframe(id);
    EXPECT_TRUE(keyframe.parent.valid() || atlas.root(keyframe.map) == id);
    for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
      const LandmarkId landmark = keyframe.landmarks[i];
      if (!landmark.valid()) continue;
      ASSERT_TRUE(atlas.has(landmark));
      EXPECT_EQ(atlas.keypoint_of(landmark, id), static_cast<int>(i));
      EXPECT_TRUE(atlas.landmark(landmark).position.allFinite());
    }
  }
}

/// Largest distance between where a keyframe sees a landmark and where it should be seen [px], of the better
/// nine tenths.
double reprojection_error(const Revisit& revisit) {
  const Atlas& atlas = revisit.mapped.atlas;
  std::vector<double> errors;
  for (const KeyframeId id : atlas.keyframe_ids()) {
    const Keyframe& keyframe = atlas.keyframe(id);
    for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
      if (!keyframe.landmarks[i].valid()) continue;
      const Eigen::Vector3d point = keyframe.cam_from_world * atlas.landmark(keyframe.landmarks[i]).position;
      const Eigen::Vector2d pixel = revisit.mapped.scene.camera.project(point);
      errors.push_back((pixel - keyframe.measurements[i].pixel.cast<double>()).norm());
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors[errors.size() * 9 / 10];
}

TEST(LoopReport, BringsTheSecondVisitToTheFirst) {
  Revisit revisit{Scene(500)};
  revisit.visit_first(6);
  revisit.visit_second(revisit.mapped.scene, 6);
  std::vector<Pose> truth;
  for (const KeyframeId id : revisit.second) truth.push_back(revisit.truth(id));
  const int landmarks = revisit.mapped.atlas.landmark_count();
  const LoopReport done = close(revisit, revisit.second[4], revisit.first[4]);
  const Atlas& atlas = revisit.mapped.atlas;
  EXPECT_FALSE(done.merged);
  EXPECT_EQ(done.keyframes, 12);
  EXPECT_GT(done.fused, 100);
  EXPECT_NEAR(done.drift, 0.25, 0.15);
  EXPECT_LT(atlas.landmark_count(), landmarks - 100) << "what both visits see is one";
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(centre_error(atlas.keyframe(revisit.second[i]).cam_from_world, truth[i]), 0.03) << i;
    EXPECT_LT(angle_error(atlas.keyframe(revisit.second[i]).cam_from_world, truth[i]), 0.02) << i;
  }
  EXPECT_EQ(atlas.keyframe(revisit.second[4]).loops, std::vector<KeyframeId>{revisit.first[4]});
  EXPECT_EQ(atlas.keyframe(revisit.first[0]).cam_from_world.translation,
            revisit.mapped.views[0].cam_from_world.translation)
      << "the world stays";
  expect_whole(atlas);
}

TEST(LoopReport, TheVisitsSeeEachOtherAfterwards) {
  Revisit revisit{Scene(500)};
  revisit.visit_first(5);
  revisit.visit_second(revisit.mapped.scene, 5);
  close(revisit, revisit.second[3], revisit.first[3]);
  const Keyframe& current = revisit.mapped.atlas.keyframe(revisit.second[3]);
  const auto across =
      std::count_if(current.covisible.begin(), current.covisible.end(),
                    [&](const Covisible& c) { return c.keyframe.value < revisit.first.size(); });
  EXPECT_GE(across, 3);
}

TEST(LoopReport, SameBytesEveryTime) {
  const auto run = [] {
    Revisit revisit{Scene(400)};
    revisit.visit_first(4);
    revisit.visit_second(revisit.mapped.scene, 4);
    close(revisit, revisit.second[2], revisit.first[2]);
    return revisit.mapped.atlas.keyframe(revisit.second[3]).cam_from_world;
  };
  const Pose first = run(), second = run();
  EXPECT_EQ(first.rotation.coeffs(), second.rotation.coeffs());
  EXPECT_EQ(first.translation, second.translation);
}

/// The second visit knows nothing of the first: a map of its own.
Revisit two_maps() {
  Revisit revisit{Scene(500)};
  revisit.visit_first(5);
  revisit.mapped.start_map();
  revisit.visit_second(revisit.mapped.scene, 5);
  return revisit;
}

void expect_merged(Revisit& revisit, const LoopReport& done, const std::vector<Pose>& truth) {
  const Atlas& atlas = revisit.mapped.atlas;
  EXPECT_TRUE(done.merged);
  EXPECT_EQ(done.keyframes, 10);
  EXPECT_FALSE(atlas.root({1}).valid());
  EXPECT_EQ(atlas.keyframe_count({0}), 10);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(centre_error(atlas.keyframe(revisit.second[i]).cam_from_world, truth[i]), 0.02) << i;
    EXPECT_LT(angle_error(atlas.keyframe(revisit.second[i]).cam_from_world, truth[i]), 0.01) << i;
  }
  expect_whole(atlas);
  EXPECT_LT(reprojection_error(revisit), 3);
}

TEST(LoopReport, MergesTheYoungerMapIntoTheOlder) {
  Revisit revisit = two_maps();
  ASSERT_EQ(revisit.mapped.atlas.map_count(), 2);
  std::vector<Pose> truth;
  for (const KeyframeId id : revisit.second) truth.push_back(revisit.truth(id));
  expect_merged(revisit, close(revisit, revisit.second[2], revisit.first[2]), truth);
}

TEST(LoopReport, AlsoWhenTheCameraIsInTheOlder) {
  Revisit revisit = two_maps();
  std::vector<Pose> truth;
  for (const KeyframeId id : revisit.second) truth.push_back(revisit.truth(id));
  expect_merged(revisit, close(revisit, revisit.first[2], revisit.second[2]), truth);
}

TEST(LoopCorrection, OnceClosedBothVisitsAreOnePlace) {
  Revisit revisit{Scene(500)};
  revisit.visit_first(5);
  const LoopTools tools = tools_for(revisit);
  PlaceRecogniser places({tools.sensor, {}}, {});
  for (const KeyframeId id : revisit.first) {
    EXPECT_FALSE(places.find_loop(revisit.mapped.atlas, id, true));
    places.add(revisit.mapped.atlas, id);
  }
  revisit.visit_second(revisit.mapped.scene, 5);
  int found = 0;
  for (const KeyframeId id : revisit.second) {
    const auto loop = places.find_loop(revisit.mapped.atlas, id, true);
    places.add(revisit.mapped.atlas, id);
    if (!loop) continue;
    ++found;
    places.reset_detection();
    close_loop(tools, revisit.mapped.atlas, *loop);
  }
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace stdc
