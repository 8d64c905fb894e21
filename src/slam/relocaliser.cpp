#include "slam/relocaliser.hpp"

#include <algorithm>
#include <utility>

namespace stdc {

/// The newest first.
std::vector<KeyframeId> Relocaliser::latest_keyframes(const Atlas& atlas) const {
  std::vector<KeyframeId> keyframes = atlas.keyframe_ids();
  std::reverse(keyframes.begin(), keyframes.end());
  const auto max_keyframes = static_cast<std::size_t>(settings_.relocalisation_keyframes);
  if (keyframes.size() > max_keyframes) keyframes.resize(max_keyframes);
  return keyframes;
}

bool Relocaliser::find(const Atlas& atlas, const PlaceRecogniser& places, TrackedFrame& frame,
                       Tracker& tracker, LocalMap& local_map) const {
  const ImageOfPlace image{*frame.features, frame.motion};
  for (const KeyframeId keyframe : latest_keyframes(atlas)) {
    const auto place = places.locate_near(atlas, keyframe, image);
    if (place && confirm(atlas, *place, frame, tracker, local_map)) return true;
  }
  for (const PlacePose& place : places.locate(atlas, image)) {
    if (confirm(atlas, place, frame, tracker, local_map)) return true;
  }
  return false;
}

bool Relocaliser::confirm(const Atlas& atlas, const PlacePose& place, TrackedFrame& frame, Tracker& tracker,
                          LocalMap& local_map) const {
  std::vector<LandmarkId> seen(static_cast<std::size_t>(frame.features->size()));
  for (const PlaceObservation& o : place.observations) seen[o.keypoint] = o.landmark;
  local_map = make_local_map(atlas, seen, place.keyframe, settings_.local_keyframes);
  frame.cam_from_world = place.cam_from_world;
  std::vector<FrameMatch> matches;
  for (int i = 0; i < frame.features->size(); ++i) {
    const int landmark = seen[i].valid() ? local_map.find(seen[i]) : -1;
    if (landmark >= 0) matches.push_back({i, landmark, local_map.landmarks[landmark].position});
  }
  constexpr double kWider = 2.5;  // the pose is rougher than that of a tracked frame
  if (!tracker.refine(frame, local_map, std::move(matches), kWider * settings_.local_map_radius,
                      settings_.relocalisation_inliers)) {
    return false;
  }
  tracker.remember(frame, local_map.reference, local_map.reference_from_world);
  return true;
}

}  // namespace stdc
