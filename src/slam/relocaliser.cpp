#include "slam/relocaliser.hpp"

#include <algorithm>
#include <utility>

#include "place_recognition/relocalisation.hpp"

namespace stdc {

/// The newest first.
std::vector<KeyframeId> Relocaliser::latest_keyframes(const Atlas& atlas) const {
  std::vector<KeyframeId> keyframes = atlas.keyframe_ids();
  std::reverse(keyframes.begin(), keyframes.end());
  const auto most = static_cast<std::size_t>(settings_.relocalisation_keyframes);
  if (keyframes.size() > most) keyframes.resize(most);
  return keyframes;
}

bool Relocaliser::find(const Atlas& atlas, const LoopCloser& places, const Pyramid& pyramid,
                       TrackedFrame& frame, Tracker& tracker, LocalMap& local_map) const {
  constexpr int kMinInliers = 15;  // of one keyframe; the local map must then give many more
  for (const KeyframeId keyframe : latest_keyframes(atlas)) {
    const auto found = locate_by_keyframe(camera_, atlas, keyframe, *frame.features, kMinInliers, settings_,
                                          noise_, optimisation_);
    if (!found) continue;
    const Guess guess{keyframe, found->cam_from_world, found->landmarks};
    if (confirm(atlas, pyramid, guess, frame, tracker, local_map)) return true;
  }
  for (const LoopCloser::FramePlace& place : places.locate(atlas, {*frame.features, frame.motion})) {
    Guess guess{place.keyframe, place.pose.cam_from_world,
                std::vector<LandmarkId>(static_cast<std::size_t>(frame.features->size()))};
    for (const PlaceObservation& s : place.pose.observations) guess.landmarks[s.keypoint] = s.landmark;
    if (confirm(atlas, pyramid, guess, frame, tracker, local_map)) return true;
  }
  return false;
}

bool Relocaliser::confirm(const Atlas& atlas, const Pyramid& pyramid, const Guess& guess, TrackedFrame& frame,
                          Tracker& tracker, LocalMap& local_map) const {
  local_map = make_local_map(atlas, guess.landmarks, guess.near, settings_.local_keyframes);
  frame.cam_from_world = guess.cam_from_world;
  std::vector<FrameMatch> matches;
  for (int i = 0; i < frame.features->size(); ++i) {
    const int landmark = guess.landmarks[i].valid() ? local_map.find(guess.landmarks[i]) : -1;
    if (landmark >= 0) matches.push_back({i, landmark, local_map.landmarks[landmark].position});
  }
  constexpr double kWider = 2.5;  // the pose is rougher than that of a tracked frame
  if (!tracker.refine(frame, local_map, pyramid, std::move(matches), kWider * settings_.local_map_radius,
                      settings_.relocalisation_inliers)) {
    return false;
  }
  tracker.remember(frame, local_map.reference, local_map.reference_from_world);
  return true;
}

}  // namespace stdc
