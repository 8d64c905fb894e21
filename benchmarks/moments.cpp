#include "moments.hpp"

#include <algorithm>

namespace stdc {

const Footage& footage() {
  static const Footage loaded = load_footage();
  return loaded;
}

namespace {

std::vector<FrameMatch> optimise(const Replay& replay, TrackedFrame& frame, std::vector<FrameMatch> matches) {
  const Settings& s = replay.settings();
  const auto result = optimise_pose(replay.camera(), make_observations(frame, matches), frame.cam_from_world,
                                    s.noise, s.pose_optimisation);
  frame.cam_from_world = result.cam_from_world;
  std::vector<FrameMatch> agreeing;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (result.inlier[i] != 0) agreeing.push_back(matches[i]);
  }
  return agreeing;
}

/// `velocity`: twist per second of the camera when the last frame was taken.
Moment take_moment(const Replay& replay, const Vector6d& velocity) {
  const TrackingSettings& settings = replay.settings().tracking;
  const TrackedFrame& last = replay.tracker().last();
  const Pose predicted_pose =
      Pose::exp(velocity * (replay.frame().timestamp - last.timestamp)) * last.cam_from_world;
  Features raw = FeatureExtractor(replay.settings().features).extract(replay.image().colour);
  Moment moment{replay.image(),
                std::move(raw),
                replay.pyramid(),
                replay.tracker(),
                replay.local_map(),
                replay.frame(),
                replay.frame(),
                {},
                {},
                {},
                {}};
  moment.predicted.cam_from_world = predicted_pose;
  moment.predicted.set_motion(replay.camera(), velocity);
  moment.located = moment.predicted;
  moment.from_last = optimise(replay, moment.located,
                              match_last_frame(replay.camera(), moment.local_map, last, moment.predicted,
                                               settings.search_radius, settings));
  moment.from_map = moment.from_last;
  std::vector<int> visible;
  match_local_map(replay.camera(), moment.local_map, moment.located, settings.local_map_radius, settings,
                  moment.from_map, visible);
  moment.observations = make_observations(moment.located, moment.from_map);
  return moment;
}

std::vector<Moment> take_moments() {
  constexpr std::size_t kMoments = 30, kFirst = 10;  // the map must have grown a little
  std::vector<Moment> moments;
  Replay replay(footage(), {});
  const std::size_t step = std::max<std::size_t>(1, footage().frames.size() / kMoments);
  Vector6d velocity = Vector6d::Zero();
  for (std::size_t i = 1; i < footage().frames.size(); ++i) {
    replay.look();
    const TrackedFrame last = replay.tracker().last();
    if (i >= kFirst && i % step == 0) moments.push_back(take_moment(replay, velocity));
    if (const auto keyframe = replay.track()) {
      replay.map_keyframe(*keyframe);
      replay.follow_atlas();
    }
    const TrackedFrame& now = replay.tracker().last();
    const double dt = now.timestamp - last.timestamp;
    if (dt > 0) velocity = (now.cam_from_world * last.cam_from_world.inverse()).log() / dt;
  }
  return moments;
}

}  // namespace

const std::vector<Moment>& Moments::all() {
  static const std::vector<Moment> taken = take_moments();
  return taken;
}

}  // namespace stdc
