#include "loop_closing/loop_closer.hpp"

#include <algorithm>

namespace stdc {

void LoopCloser::enter_all(const Atlas& atlas) {
  for (const KeyframeId id : atlas.keyframe_ids()) {
    index_.add(id, atlas.keyframe(id).features->descriptors());
    entered_.push_back(id);
  }
}

std::optional<VerifiedLoop> LoopCloser::find(const Atlas& atlas, KeyframeId current) {
  std::erase_if(entered_, [&](KeyframeId id) {
    if (atlas.has(id)) return false;
    index_.remove(id);
    return true;
  });
  std::optional<VerifiedLoop> loop;
  if (tools_.settings.active) loop = look(atlas, current);
  if (atlas.has(current)) {
    index_.add(current, atlas.keyframe(current).features->descriptors());
    entered_.push_back(current);
  }
  return loop;
}

std::optional<VerifiedLoop> LoopCloser::look(const Atlas& atlas, KeyframeId current) {
  const std::vector<KeyframeId> candidates = detector_.detect(atlas, index_, current);
  const bool soon = last_loop_.valid() &&
                    static_cast<int>(current.value - last_loop_.value) < tools_.settings.keyframes_between;
  for (const KeyframeId candidate : candidates) {
    const bool same_map = atlas.keyframe(candidate).map == atlas.keyframe(current).map;
    if (same_map && soon) continue;
    auto loop =
        verify_loop(tools_.camera, atlas, current, candidate, tools_.noise, optimisation_, tools_.settings);
    if (loop) return loop;
  }
  return {};
}

LoopCorrection LoopCloser::close(Atlas& atlas, const VerifiedLoop& loop) {
  last_loop_ = loop.current;
  detector_.reset();
  return close_loop(tools_, atlas, loop);
}

std::vector<LoopCloser::FramePlace> LoopCloser::locate(const Atlas& atlas, const ImageOfPlace& image) const {
  std::vector<FramePlace> places;
  if (image.features.size() < tools_.settings.ransac_inliers) return places;
  constexpr std::size_t kLookedAt = 30;
  std::vector<std::uint8_t> tried(atlas.keyframe_id_limit(), 0);
  int windows = 0;
  for (const PlaceMatch& match : index_.query(image.features.descriptors(), {}, kLookedAt)) {
    if (!atlas.has(match.keyframe) || tried[match.keyframe.value] != 0) continue;
    if (windows++ == tools_.settings.candidates) break;
    const auto window = place_window(atlas, match.keyframe, tools_.settings.window);
    for (const KeyframeId id : window) tried[id.value] = 1;
    auto pose =
        find_in_place(tools_.camera, atlas, window, image, tools_.noise, optimisation_, tools_.settings);
    if (pose) places.push_back({match.keyframe, std::move(*pose)});
  }
  std::stable_sort(places.begin(), places.end(), [](const FramePlace& a, const FramePlace& b) {
    return a.pose.observations.size() > b.pose.observations.size();
  });
  return places;
}

}  // namespace stdc
