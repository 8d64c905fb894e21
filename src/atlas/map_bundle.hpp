#pragma once

#include <vector>

#include "atlas/atlas.hpp"
#include "estimation/bundle_adjustment.hpp"

namespace stdc {

/// A part of a map as a bundle adjustment problem, and what its indices stand for.
struct MapBundle {
  BundleProblem problem;
  std::vector<KeyframeId> keyframes;  ///< the moving ones first
  int moving = 0;
  std::vector<LandmarkId> landmarks;
  std::vector<int> keypoints;  ///< per observation
};

/// All landmarks that the moving keyframes see, and the observations that they and the fixed ones have of
/// them. The root of a map is its world and fixed in any case.
MapBundle make_map_bundle(const Atlas& atlas, const std::vector<KeyframeId>& moving,
                          const std::vector<KeyframeId>& fixed);

/// The landmarks that keyframes see, by id.
std::vector<LandmarkId> landmarks_of(const Atlas& atlas, const std::vector<KeyframeId>& keyframes);

/// Other keyframes that see the landmarks, those that see most of them first.
std::vector<KeyframeId> other_observers(const Atlas& atlas, const std::vector<KeyframeId>& keyframes,
                                        int max_count);

/// Takes the solution into the unchanged map: poses, positions; observations that turned out to be outliers
/// are forgotten. Returns how many. Nothing is changed if the result is not usable.
int apply_bundle(Atlas& atlas, const MapBundle& bundle, const BundleResult& result);

}  // namespace stdc
