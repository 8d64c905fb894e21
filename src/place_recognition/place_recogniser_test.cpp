#include "place_recognition/place_recogniser.hpp"

#include <gtest/gtest.h>

#include "place_recognition/test_revisit.hpp"

namespace stdc {
namespace {

using test::Revisit;
using test::Scene;

PlaceRecogniser recogniser_for(const Revisit& revisit) {
  return {{{revisit.mapped.scene.camera, {}}, {}}, {}};
}

/// How many keyframes of the second visit find the first.
int loops_found(Revisit& revisit, bool same_map) {
  PlaceRecogniser places = recogniser_for(revisit);
  for (const KeyframeId id : revisit.first) places.add(revisit.mapped.atlas, id);
  int found = 0;
  for (const KeyframeId id : revisit.second) {
    found += places.find_loop(revisit.mapped.atlas, id, same_map) ? 1 : 0;
    places.add(revisit.mapped.atlas, id);
  }
  return found;
}

TEST(PlaceRecogniser, FindsTheFirstVisitInTheSecond) {
  Revisit revisit{Scene(500)};
  revisit.visit_first(5);
  revisit.visit_second(revisit.mapped.scene, 5);
  EXPECT_GT(loops_found(revisit, true), 0);
  EXPECT_EQ(loops_found(revisit, false), 0) << "both visits are of one map";
}

TEST(PlaceRecogniser, FindsAnotherMapInAnyCase) {
  Revisit revisit{Scene(500)};
  revisit.visit_first(5);
  revisit.mapped.start_map();
  revisit.visit_second(revisit.mapped.scene, 5);
  EXPECT_GT(loops_found(revisit, false), 0);
}

TEST(PlaceRecogniser, LocatesAFrameByItsLooks) {
  Revisit revisit{Scene(500)};
  revisit.visit_first(5);
  PlaceRecogniser places = recogniser_for(revisit);
  places.add_all(revisit.mapped.atlas);
  test::ViewOptions options;
  options.depth_noise = 0.003;
  options.pixel_noise = 0.4;
  options.seed = 55;
  const test::View view = revisit.mapped.scene.look(test::camera_at(0.15, 0, 0.1, 0.02, 0.03, 0.1), options);
  const auto found = places.locate(revisit.mapped.atlas, {*view.features, view.motion});
  ASSERT_FALSE(found.empty());
  EXPECT_LT(test::centre_error(found.front().cam_from_world, view.cam_from_world), 0.01);
  const auto near = places.locate_near(revisit.mapped.atlas, revisit.first[1], {*view.features, view.motion});
  ASSERT_TRUE(near);
  EXPECT_EQ(near->keyframe, revisit.first[1]);
  EXPECT_LT(test::centre_error(near->cam_from_world, view.cam_from_world), 0.02);
  const test::View elsewhere = Scene(500, false, 9).look(test::camera_at(0, 0, 0), options);
  EXPECT_TRUE(places.locate(revisit.mapped.atlas, {*elsewhere.features, elsewhere.motion}).empty());
}

TEST(PlaceRecogniser, WhatWasCulledIsForgotten) {
  Revisit revisit{Scene(400)};
  revisit.visit_first(5);
  PlaceRecogniser places = recogniser_for(revisit);
  for (int k = 0; k < 4; ++k) places.add(revisit.mapped.atlas, revisit.first[k]);
  revisit.mapped.atlas.remove(revisit.first[2]);
  EXPECT_FALSE(places.find_loop(revisit.mapped.atlas, revisit.first[4], true));
  const auto found = places.locate(revisit.mapped.atlas, {*revisit.mapped.views[2].features, {}});
  for (const PlacePose& place : found) EXPECT_NE(place.keyframe, revisit.first[2]);
}

}  // namespace
}  // namespace stdc
