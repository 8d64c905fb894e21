#pragma once

#include <vector>

#include "atlas/test_scene.hpp"

namespace stdc::test {

/// Two visits of a room. In the second one the map has drifted away from the first and has landmarks of its
/// own.
struct Revisit {
  MappedScene mapped;
  Pose drift;  ///< world of the second visit from the true world
  std::vector<KeyframeId> first, second;

  explicit Revisit(const Scene& room, const Vector6d& drift_twist = usual_drift());

  static Vector6d usual_drift();

  void visit_first(int keyframes);
  /// @param room  what is seen: the mapped one, or another that should not be taken for it
  void visit_second(const Scene& room, int keyframes, const Pose& aside = Pose());
  /// Where a keyframe of the second visit is in the coordinates of the first.
  Pose truth(KeyframeId id) const;

 private:
  static Pose pose(int k);
  static ViewOptions options(std::uint64_t seed);
};

}  // namespace stdc::test
