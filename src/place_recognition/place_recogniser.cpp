#include "place_recognition/place_recogniser.hpp"

#include <algorithm>

namespace stdc {

void PlaceRecogniser::add_all(const Atlas& atlas) {
  for (const KeyframeId id : atlas.keyframe_ids()) {
    index_.add(id, atlas.keyframe(id).features->descriptors());
    indexed_.push_back(id);
  }
}

void PlaceRecogniser::remove_culled(const Atlas& atlas) {
  std::erase_if(indexed_, [&](KeyframeId id) {
    if (atlas.has(id)) return false;
    index_.remove(id);
    return true;
  });
}

void PlaceRecogniser::add(const Atlas& atlas, KeyframeId current) {
  remove_culled(atlas);
  if (!atlas.has(current)) return;
  index_.add(current, atlas.keyframe(current).features->descriptors());
  indexed_.push_back(current);
}

std::optional<VerifiedLoop> PlaceRecogniser::find_loop(const Atlas& atlas, KeyframeId current,
                                                       bool same_map) {
  remove_culled(atlas);
  for (const KeyframeId candidate : detector_.detect(atlas, index_, current)) {
    if (!same_map && atlas.keyframe(candidate).map == atlas.keyframe(current).map) continue;
    if (auto loop = verify_loop(estimator_, atlas, current, candidate, settings_)) return loop;
  }
  return {};
}

std::optional<PlacePose> PlaceRecogniser::locate_near(const Atlas& atlas, KeyframeId keyframe,
                                                      const ImageOfPlace& image) const {
  return find_in_place(estimator_, atlas, {keyframe}, image, {settings_.ransac_inliers, 0}, settings_);
}

std::vector<PlacePose> PlaceRecogniser::locate(const Atlas& atlas, const ImageOfPlace& image) const {
  std::vector<PlacePose> places;
  if (image.features.size() < settings_.ransac_inliers) return places;
  constexpr std::size_t kMaxMatches = 30;
  std::vector<std::uint8_t> tried(atlas.keyframe_id_limit(), 0);
  int windows = 0;
  for (const PlaceMatch& match : index_.query(image.features.descriptors(), {}, kMaxMatches)) {
    if (!atlas.has(match.keyframe) || tried[match.keyframe.value] != 0) continue;
    if (windows++ == settings_.candidates) break;
    const auto window = place_window(atlas, match.keyframe, settings_.window);
    for (const KeyframeId id : window) tried[id.value] = 1;
    auto pose = find_in_place(estimator_, atlas, window, image, {settings_.min_inliers, settings_.min_share},
                              settings_);
    if (pose) places.push_back(std::move(*pose));
  }
  std::stable_sort(places.begin(), places.end(), [](const PlacePose& a, const PlacePose& b) {
    return a.observations.size() > b.observations.size();
  });
  return places;
}

}  // namespace stdc
