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
inline int point_seen(const MappedScene& mapped, const Observation& observation) {
  return mapped.views[observation.keyframe.value].points[observation.keypoint];
}

/// Whether all observations of a landmark show the same point.
inline bool is_pure(const MappedScene& mapped, const Landmark& landmark) {
  const int first = point_seen(mapped, landmark.observations.front());
  return std::all_of(landmark.observations.begin(), landmark.observations.end(),
                     [&](const Observation& o) { return point_seen(mapped, o) == first; });
}

}  // namespace stdc::test
