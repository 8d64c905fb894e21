// How the pipeline's map comes to be: keyframes, new maps, a map of an earlier run, and what is read from it.
#include <algorithm>
#include <span>
#include <utility>

#include "atlas/storage/map_file.hpp"
#include "core/error.hpp"
#include "core/stopwatch.hpp"
#include "dense/mesh/make_mesh.hpp"
#include "slam/pipeline.hpp"
#include "tracking/keyframe_policy.hpp"

namespace stdc {

namespace {

constexpr double kOriginInformation = 1e12;  ///< a map's first camera is where it is by definition

}  // namespace

/// Makes the frame a keyframe if it should be one, gives the back end its next job, and notes the pose.
void Pipeline::extend_map(TrackedFrame& frame, TrackingResult& result) {
  Stopwatch watch;
  const bool by_depth = std::exchange(extends_by_depth_, false);
  if ((result.status == TrackingStatus::ok || by_depth) && wants_keyframe(frame))
    make_keyframe(frame, active_map_);
  result.is_keyframe = last_keyframe_frame_ == frame.index;
  back_end_.start_pending(frame.index);
  if (result.status == TrackingStatus::ok) record(frame);
  result.milliseconds.keyframe += watch.lap_ms();
}

/// Whether a map could be started with a frame.
bool Pipeline::shows_enough(const TrackedFrame& frame) const {
  int with_depth = 0;
  for (int i = 0; i < frame.features->size(); ++i) with_depth += frame.features->depth(i) > 0 ? 1 : 0;
  return with_depth >= settings_.tracking.initial_landmarks;
}

/// Starts a map with this frame, if enough of it has depth.
bool Pipeline::initialise(TrackedFrame& frame) {
  if (settings_.system.localisation_only || back_end_.has_pending() || !shows_enough(frame)) return false;
  make_keyframe(frame, back_end_.atlas().next_map());
  map_began_ = frame.timestamp;
  frame.information.setIdentity();
  frame.information *= kOriginInformation;
  frame.matches = frame.inliers = static_cast<int>(std::count_if(
      frame.landmarks.begin(), frame.landmarks.end(), [](LandmarkId id) { return id.valid(); }));
  return true;
}

/// Lost for good: so many frames with enough to see showed no known place.
bool Pipeline::start_over(TrackedFrame& frame) {
  if (!shows_enough(frame)) return false;
  // What covered most of the view when the camera was lost may still do so: a map must not begin on it.
  constexpr int kPatience = 5;
  const int wait = settings_.tracking.new_map_after * (covered_ ? kPatience : 1);
  if (++unknown_frames_ <= wait) return false;
  frame = TrackedFrame(camera(), frame.index, frame.timestamp, frame.features, frame.pyramid);
  return initialise(frame);
}

bool Pipeline::wants_keyframe(const TrackedFrame& frame) const {
  if (settings_.system.localisation_only || !back_end_.idle() || back_end_.has_pending()) return false;
  if (last_keyframe_frame_ == frame.index) return false;
  return needs_keyframe(camera(), frame, local_map_, frame.index - last_keyframe_frame_,
                        back_end_.atlas().keyframe_count(active_map_), settings_.tracking);
}

void Pipeline::make_keyframe(TrackedFrame& frame, MapId map) {
  Atlas& atlas = back_end_.atlas();
  tracker_.flush_counts(atlas);
  if (motion_ && frame.index == observed_frame_) mark_dynamic(frame);
  const std::size_t first_landmark = atlas.landmark_id_limit();
  last_keyframe_ = insert_keyframe(atlas, sensor_, frame, settings_.tracking, map);
  last_keyframe_frame_ = frame.index;
  active_map_ = map;
  unknown_frames_ = 0;
  settled_ = true;
  refresh_local_map(frame.landmarks);
  tracker_.remember(frame, last_keyframe_, frame.cam_from_world);
  back_end_.map_keyframe(last_keyframe_, first_landmark, frame.index);
}

void Pipeline::refresh_local_map(const std::vector<LandmarkId>& seen) {
  local_map_ = make_local_map(back_end_.atlas(), seen, last_keyframe_, settings_.tracking.local_keyframes);
}

void Pipeline::record(const TrackedFrame& frame) {
  if (settings_.system.localisation_only) {
    tracker_.drop_counts();
    return;
  }
  posed_.push_back({frame.index, frame.timestamp, local_map_.reference, from_reference(frame)});
}

std::vector<LoopReport> Pipeline::finish() {
  std::vector<LoopReport> loops;
  const int frame = next_frame_ - 1;
  while (back_end_.busy()) {
    back_end_.flush();
    const BackEndUpdate update = back_end_.collect(frame, true);
    if (update.atlas_changed) follow_atlas();
    if (update.loop) loops.push_back(*update.loop);
    back_end_.start_pending(frame);
  }
  if (std::exchange(landmarks_removed_, false)) back_end_.refresh_snapshot();
  hand_over_dense();
  return loops;
}

void Pipeline::load_map(const std::filesystem::path& path) {
  if (next_frame_ > 0) throw Error(path.string(), "was given after the first frame", "load the map before");
  StoredMap stored = stdc::load_map(path);
  if (settings_.system.localisation_only && stored.atlas.keyframe_count() == 0) {
    throw Error(path.string(), "holds an empty map: there is nothing to find the camera in",
                "give the map of a run in which frames got a pose");
  }
  stored.camera.rotation = camera().rotation;  // for the network only: a map does not know it
  if (stored.camera != camera()) {
    throw Error(path.string(), "was made with another camera",
                "give the camera that 'stdc-slam map info' shows, or make the map again");
  }
  first_own_keyframe_ = {static_cast<std::uint32_t>(stored.atlas.keyframe_id_limit())};
  if (dense_) {
    const AtlasSnapshot snapshot(stored.atlas);
    for (MapId map{0}; map < stored.atlas.next_map(); ++map.value) {
      dense_->set_views(place_views(stored.views, snapshot, map), map);
    }
  } else {
    loaded_views_ = std::move(stored.views);
  }
  back_end_.set_atlas(std::move(stored.atlas));
}

std::vector<FramePose> Pipeline::trajectory(std::size_t count) const {
  const AtlasSnapshot& snapshot = back_end_.snapshot();
  count = std::min(count, posed_.size());
  std::vector<FramePose> poses;
  poses.reserve(count);
  for (const PosedFrame& posed : std::span(posed_).last(count)) {
    const Pose cam_from_world = snapshot.cam_from_world(posed.reference, posed.frame_from_reference);
    poses.push_back({posed.frame, posed.timestamp, cam_from_world.inverse(),
                     snapshot.keyframes()[posed.reference.value].map});
  }
  return poses;
}

}  // namespace stdc
