#include "place_recognition/loop_detector.hpp"

#include <gtest/gtest.h>

#include "place_recognition/test_revisit.hpp"

namespace stdc {
namespace {

using test::Revisit;
using test::Scene;

PlaceIndex index_of(const Atlas& atlas, const std::vector<KeyframeId>& keyframes) {
  PlaceIndex index;
  for (const KeyframeId id : keyframes) index.add(id, atlas.keyframe(id).features->descriptors());
  return index;
}

/// A long way between the two visits: keyframes that see something else.
void go_elsewhere(Revisit& revisit, PlaceIndex& index) {
  const std::size_t before = revisit.second.size();
  revisit.visit_second(Scene(300, false, 55), 4);
  for (std::size_t k = before; k < revisit.second.size(); ++k) {
    const KeyframeId id = revisit.second[k];
    index.add(id, revisit.mapped.atlas.keyframe(id).features->descriptors());
  }
  revisit.second.resize(before);
}

TEST(LoopDetector, FindsAPlaceThatSeveralKeyframesInSuccessionSee) {
  Revisit revisit{Scene(400)};
  revisit.visit_first(5);
  PlaceIndex index = index_of(revisit.mapped.atlas, revisit.first);
  go_elsewhere(revisit, index);
  revisit.visit_second(revisit.mapped.scene, 4);
  PlaceRecognitionSettings settings;
  settings.consistency = 3;
  LoopDetector detector(settings);
  for (std::size_t k = 0; k < revisit.second.size(); ++k) {
    const auto found = detector.detect(revisit.mapped.atlas, index, revisit.second[k]);
    ASSERT_EQ(found.empty(), k < 2) << k;
    if (k >= 2) {
      EXPECT_LE(found.front(), revisit.first.back());
    }
    index.add(revisit.second[k], revisit.mapped.atlas.keyframe(revisit.second[k]).features->descriptors());
  }
  detector.reset();
  EXPECT_TRUE(detector.detect(revisit.mapped.atlas, index, revisit.second.back()).empty())
      << "from the start";
}

TEST(LoopDetector, OnePlaceIsNamedOnce) {
  Revisit revisit{Scene(400)};
  revisit.visit_first(6);
  const PlaceIndex index = index_of(revisit.mapped.atlas, revisit.first);
  revisit.visit_second(revisit.mapped.scene, 1);
  PlaceRecognitionSettings settings;
  settings.consistency = 1;
  LoopDetector detector(settings);
  EXPECT_EQ(detector.detect(revisit.mapped.atlas, index, revisit.second[0]).size(), 1U);
}

TEST(LoopDetector, NeighboursAreNoLoops) {
  Revisit revisit{Scene(400)};
  revisit.visit_first(6);
  const PlaceIndex index = index_of(revisit.mapped.atlas, revisit.first);
  PlaceRecognitionSettings settings;
  settings.consistency = 1;
  LoopDetector detector(settings);
  for (const KeyframeId id : revisit.first)
    EXPECT_TRUE(detector.detect(revisit.mapped.atlas, index, id).empty());
}

TEST(LoopDetector, WhatLooksMuchLessAlikeThanTheNeighboursIsNoPlace) {
  Revisit revisit{Scene(400)};
  revisit.visit_first(5);
  PlaceIndex index = index_of(revisit.mapped.atlas, revisit.first);
  PlaceRecognitionSettings settings;
  settings.consistency = 1;
  LoopDetector detector(settings);
  revisit.visit_second(Scene(400, false, 55), 3);
  for (const KeyframeId id : revisit.second)
    index.add(id, revisit.mapped.atlas.keyframe(id).features->descriptors());
  EXPECT_TRUE(detector.detect(revisit.mapped.atlas, index, revisit.second.back()).empty());
}

TEST(LoopDetector, PlacesThatWereRemovedFromTheMapAreIgnored) {
  Revisit revisit{Scene(400)};
  revisit.visit_first(3);
  const PlaceIndex index = index_of(revisit.mapped.atlas, {revisit.first[1], revisit.first[2]});
  revisit.visit_second(revisit.mapped.scene, 1);
  revisit.mapped.atlas.remove(revisit.first[1]);
  revisit.mapped.atlas.remove(revisit.first[2]);
  PlaceRecognitionSettings settings;
  settings.consistency = 1;
  EXPECT_TRUE(LoopDetector(settings).detect(revisit.mapped.atlas, index, revisit.second[0]).empty());
}

}  // namespace
}  // namespace stdc
