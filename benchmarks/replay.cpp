#include "replay.hpp"

#include "core/error.hpp"
#include "mapping/culling.hpp"
#include "mapping/landmark_creation.hpp"
#include "mapping/landmark_fusion.hpp"
#include "mapping/local_bundle.hpp"
#include "tracking/keyframe_policy.hpp"

namespace stdc {
namespace {

Tracker make_tracker(const Camera& camera, const Settings& s) {
  return {{{camera, s.noise}, s.pose_optimisation}, s.tracking};
}

LocalMapper make_mapper(const Camera& camera, const Settings& s) {
  return {{camera, s.noise}, s.mapping, s.bundle_adjustment, s.tracking.close_depth};
}

}  // namespace

Replay::Replay(const Footage& footage, const Settings& settings)
    : footage_(footage),
      settings_(settings),
      extractor_(settings.features),
      tracker_(make_tracker(footage.camera, settings)),
      mapper_(make_mapper(footage.camera, settings)) {
  if (footage.frames.size() < 2) {
    throw Error("the footage", "it has fewer than two frames", "set STDC_SEQUENCE to another sequence");
  }
  begin_anew();
}

void Replay::begin_anew() {
  tracker_ = make_tracker(camera(), settings_);
  mapper_ = make_mapper(camera(), settings_);
  recent_.clear();
  atlas_ = Atlas();
  frame_ = extract();
  map_keyframe(make_keyframe());
  follow_atlas();
}

TrackedFrame Replay::extract() {
  const cv::Mat& grey = image().colour;
  Features raw = extractor_.extract(grey);
  const auto pyramid = extractor_.pyramid();
  auto features =
      std::make_shared<FrameFeatures>(camera(), std::move(raw), image().depth,
                                      settings_.features.scale_factor, pyramid->levels(), pyramid.get());
  return {camera(), static_cast<int>(next_), image().timestamp, std::move(features), pyramid};
}

void Replay::look() {
  if (++next_ == footage_.frames.size()) {
    next_ = 0;
    begin_anew();
    next_ = 1;
  }
  frame_ = extract();
  local_map_ =
      make_local_map(atlas_, tracker_.last().landmarks, last_keyframe_, settings_.tracking.local_keyframes);
}

std::optional<KeyframeId> Replay::track() {
  if (!tracker_.track(frame_, local_map_).tracked) {
    begin_anew();
    return {};
  }
  tracker_.remember(frame_, local_map_.reference, local_map_.reference_from_world);
  const int since = frame_.index - last_keyframe_frame_;
  if (!needs_keyframe(camera(), frame_, local_map_, since, atlas_.keyframe_count(), settings_.tracking)) {
    return {};
  }
  return make_keyframe();
}

KeyframeId Replay::next_keyframe() {
  for (std::size_t frames = 0; frames < 2 * footage_.frames.size(); ++frames) {
    look();
    if (const auto keyframe = track()) return *keyframe;
  }
  throw Error("the footage", "no frame of it becomes a keyframe", "set STDC_SEQUENCE to another sequence");
}

KeyframeId Replay::make_keyframe() {
  tracker_.flush_counts(atlas_);
  last_keyframe_ = insert_keyframe(atlas_, {camera(), settings_.noise}, frame_, settings_.tracking);
  last_keyframe_frame_ = frame_.index;
  tracker_.remember(frame_, last_keyframe_, frame_.cam_from_world);
  return last_keyframe_;
}

MappingReport Replay::map_keyframe(KeyframeId keyframe) { return mapper_.process(atlas_, keyframe); }

void Replay::prepare_bundle(KeyframeId keyframe) {
  const std::size_t made_by_mapper = atlas_.landmark_id_limit();
  for (const LandmarkId landmark : atlas_.keyframe(keyframe).landmarks) {
    if (!landmark.valid()) continue;
    atlas_.refresh(landmark);
    if (atlas_.landmark(landmark).created_by == keyframe) recent_.push_back(landmark);
  }
  atlas_.update_covisibility(keyframe);
  cull_landmarks(atlas_, recent_, keyframe, settings_.mapping);
  create_landmarks(atlas_, keyframe, {camera(), settings_.noise}, settings_.mapping);
  for (auto id = static_cast<std::uint32_t>(made_by_mapper); id < atlas_.landmark_id_limit(); ++id) {
    recent_.push_back({id});
  }
  fuse_landmarks(atlas_, keyframe, {camera(), settings_.noise}, settings_.mapping);
}

LocalBundleReport Replay::adjust(KeyframeId keyframe) {
  return adjust_locally(atlas_, keyframe, {camera(), settings_.noise}, settings_.bundle_adjustment,
                        settings_.mapping);
}

void Replay::after_bundle(KeyframeId keyframe) {
  cull_keyframes(atlas_, keyframe, settings_.tracking.close_depth, settings_.mapping);
}

void Replay::follow_atlas() {
  tracker_.flush_counts(atlas_);
  tracker_.follow(atlas_);
}

}  // namespace stdc
