#include "mapping/test_keyframes.hpp"

#include <algorithm>

namespace stdc::test {

int point_seen(const MappedScene& mapped, const Observation& observation) {
  return mapped.views[observation.keyframe.value].points[observation.keypoint];
}

bool is_pure(const MappedScene& mapped, const Landmark& landmark) {
  const int first = point_seen(mapped, landmark.observations.front());
  return std::all_of(landmark.observations.begin(), landmark.observations.end(),
                     [&](const Observation& o) { return point_seen(mapped, o) == first; });
}

}  // namespace stdc::test
