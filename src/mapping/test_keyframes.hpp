#pragma once

#include "atlas/test_scene.hpp"

namespace stdc::test {

/// Adds a keyframe that sees the landmarks of those of its points that are chosen; the other keypoints stay
/// free.
template <typename Choose>
KeyframeId add_some(MappedScene& mapped, const View& view, Choose&& choose) {
  const KeyframeId id = mapped.add_bare(view);
  for (int i = 0; i < view.features->size(); ++i) {
    if (!choose(view.points[i])) continue;
    LandmarkId& landmark = mapped.landmarks[view.points[i]];
    if (!landmark.valid())
      landmark = mapped.atlas.add_landmark(mapped.scene.points[view.points[i]].position, id);
    mapped.atlas.observe(id, i, landmark);
    mapped.atlas.refresh(landmark);
  }
  mapped.atlas.update_covisibility(id);
  return id;
}

/// The point that a landmark's observation by a keyframe shows.
int point_seen(const MappedScene& mapped, const Observation& observation);

/// Whether all observations of a landmark show the same point.
bool is_pure(const MappedScene& mapped, const Landmark& landmark);

}  // namespace stdc::test
