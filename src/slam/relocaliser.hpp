#pragma once

#include <vector>

#include "atlas/atlas.hpp"
#include "place_recognition/place_recogniser.hpp"
#include "tracking/local_map.hpp"
#include "tracking/tracker.hpp"

namespace stdc {

/// Finds a frame of which nothing is known in the atlas: near the latest keyframes, or at a place of any map
/// that looks like it. Place recognition gives the pose, the landmarks around it confirm it.
class Relocaliser {
 public:
  explicit Relocaliser(const TrackingSettings& settings) : settings_(settings) {}

  /// True if the landmarks around where it seems to be agree: then the frame has its pose, the tracker goes
  /// on from there, and `local_map` is what is around it.
  bool find(const Atlas& atlas, const PlaceRecogniser& places, TrackedFrame& frame, Tracker& tracker,
            LocalMap& local_map) const;

 private:
  std::vector<KeyframeId> latest_keyframes(const Atlas& atlas) const;
  bool confirm(const Atlas& atlas, const PlacePose& place, TrackedFrame& frame, Tracker& tracker,
               LocalMap& local_map) const;

  TrackingSettings settings_;
};

}  // namespace stdc
