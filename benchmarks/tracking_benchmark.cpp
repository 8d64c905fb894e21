// Times of tracking and mapping, step by step, on real frames and the maps grown of them. The frames are the
// first 300 of the sequence folder in the environment variable STDC_SEQUENCE (TUM layout); without it, 160 of
// the rendered static-desk. The column `CPU` is that of the one thread that does the work.
//
//     STDC_SEQUENCE=path/to/sequence build/release/tracking_benchmark
//
// The steps of tracking are timed on frames taken evenly from the footage, each with the map as it was then.
// The steps of mapping are timed on the footage's keyframes in turn, the map growing as it does in a run.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "replay.hpp"
#include "tracking/frame_matching.hpp"

namespace stdc {
namespace {

const Footage& footage() {
  static const Footage loaded = load_footage();
  return loaded;
}

constexpr int kKeyframes = 20;  // timed by each benchmark of mapping

/// A frame about to be tracked, and what each step of tracking hands to the next.
struct Moment {
  RgbdImage image;
  Features raw;
  std::shared_ptr<const Pyramid> pyramid;
  Tracker tracker;
  LocalMap local_map;
  TrackedFrame fresh;                         ///< nothing is known but its features
  TrackedFrame predicted;                     ///< where it is looked for
  std::vector<FrameMatch> from_last;          ///< matches to the last frame that agree
  TrackedFrame located;                       ///< where those put it
  std::vector<FrameMatch> from_map;           ///< with those to the local map
  std::vector<PoseObservation> observations;  ///< the same for the optimiser
};

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

/// The moments in turn.
class Moments {
 public:
  Moments() { all(); }  // before the timer starts
  const Moment& next() { return all()[next_++ % all().size()]; }

 private:
  static const std::vector<Moment>& all() {
    static const std::vector<Moment> taken = take_moments();
    return taken;
  }
  std::size_t next_ = 0;
};

/// Counts things per iteration.
void count(benchmark::State& state, const char* what, std::size_t total) {
  state.counters[what] = benchmark::Counter(static_cast<double>(total), benchmark::Counter::kAvgIterations);
}

/// Undistortion, depths, index and patches of the features.
void make_frame_features(benchmark::State& state) {
  const Settings settings;
  const FeatureExtractor extractor(settings.features);
  Moments moments;
  for (auto _ : state) {
    const Moment& m = moments.next();
    benchmark::DoNotOptimize(FrameFeatures(footage().camera, m.raw, m.image.depth,
                                           settings.features.scale_factor,
                                           extractor.levels(m.image.colour.size()), m.pyramid.get()));
  }
}
BENCHMARK(make_frame_features)->Unit(benchmark::kMicrosecond);

void match_to_last_frame(benchmark::State& state) {
  const TrackingSettings settings;
  Moments moments;
  std::size_t matches = 0;
  for (auto _ : state) {
    const Moment& m = moments.next();
    matches += match_last_frame(footage().camera, m.local_map, m.tracker.last(), m.predicted,
                                settings.search_radius, settings)
                   .size();
  }
  count(state, "matches", matches);
}
BENCHMARK(match_to_last_frame)->Unit(benchmark::kMicrosecond);

void match_to_local_map(benchmark::State& state) {
  const TrackingSettings settings;
  Moments moments;
  std::size_t matches = 0, landmarks = 0;
  std::vector<int> visible;
  for (auto _ : state) {
    const Moment& m = moments.next();
    std::vector<FrameMatch> all = m.from_last;
    match_local_map(footage().camera, m.local_map, m.located, settings.local_map_radius, settings, all,
                    visible);
    matches += all.size();
    landmarks += m.local_map.landmarks.size();
  }
  count(state, "matches", matches);
  count(state, "landmarks", landmarks);
}
BENCHMARK(match_to_local_map)->Unit(benchmark::kMicrosecond);

void align_patches(benchmark::State& state) {
  const Settings settings;
  Moments moments;
  std::size_t matches = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const Moment& m = moments.next();
    TrackedFrame frame = m.located;
    matches += m.from_map.size();
    state.ResumeTiming();
    align_matches({footage().camera, settings.noise}, m.local_map, m.from_map, frame);
  }
  count(state, "matches", matches);
}
BENCHMARK(align_patches)->Unit(benchmark::kMicrosecond);

/// From the predicted pose, with all matches, right and wrong.
void optimise_pose_of_frame(benchmark::State& state) {
  const Settings settings;
  Moments moments;
  std::size_t observations = 0;
  for (auto _ : state) {
    const Moment& m = moments.next();
    benchmark::DoNotOptimize(optimise_pose(footage().camera, m.observations, m.predicted.cam_from_world,
                                           settings.noise, settings.pose_optimisation));
    observations += m.observations.size();
  }
  count(state, "observations", observations);
}
BENCHMARK(optimise_pose_of_frame)->Unit(benchmark::kMicrosecond);

/// All of tracking but the features and the local map.
void track_frame(benchmark::State& state) {
  Moments moments;
  for (auto _ : state) {
    state.PauseTiming();
    const Moment& m = moments.next();
    Tracker tracker = m.tracker;
    TrackedFrame frame = m.fresh;
    state.ResumeTiming();
    benchmark::DoNotOptimize(tracker.track(frame, m.local_map).tracked);
  }
}
BENCHMARK(track_frame)->Unit(benchmark::kMicrosecond);

/// Copying what surrounds the camera out of the map as it is at the footage's end.
void gather_local_map(benchmark::State& state) {
  Replay replay(footage(), {});
  for (std::size_t i = 1; i < footage().frames.size(); ++i) {
    replay.look();
    if (const auto keyframe = replay.track()) {
      replay.map_keyframe(*keyframe);
      replay.follow_atlas();
    }
  }
  const std::vector<LandmarkId> seen = replay.tracker().last().landmarks;
  const int keyframes = replay.settings().tracking.local_keyframes;
  for (auto _ : state) {
    benchmark::DoNotOptimize(make_local_map(replay.atlas(), seen, replay.last_keyframe(), keyframes));
  }
  state.counters["landmarks"] = replay.atlas().landmark_count();
  state.counters["keyframes"] = replay.atlas().keyframe_count();
}
BENCHMARK(gather_local_map)->Unit(benchmark::kMicrosecond);

/// LocalMapper::process.
void map_keyframe(benchmark::State& state) {
  Replay replay(footage(), {});
  for (auto _ : state) {
    state.PauseTiming();
    const KeyframeId keyframe = replay.next_keyframe();
    state.ResumeTiming();
    replay.map_keyframe(keyframe);
    state.PauseTiming();
    replay.follow_atlas();
    state.ResumeTiming();
  }
}
BENCHMARK(map_keyframe)->Iterations(kKeyframes)->Unit(benchmark::kMillisecond);

/// The local bundle adjustment within it.
void adjust_keyframe_locally(benchmark::State& state) {
  Replay replay(footage(), {});
  std::size_t observations = 0, keyframes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const KeyframeId keyframe = replay.next_keyframe();
    replay.prepare_bundle(keyframe);
    state.ResumeTiming();
    const LocalBundleReport report = replay.adjust(keyframe);
    state.PauseTiming();
    observations += static_cast<std::size_t>(report.observations);
    keyframes += static_cast<std::size_t>(report.keyframes + report.fixed_keyframes);
    replay.after_bundle(keyframe);
    replay.follow_atlas();
    state.ResumeTiming();
  }
  count(state, "observations", observations);
  count(state, "keyframes", keyframes);
}
BENCHMARK(adjust_keyframe_locally)->Iterations(kKeyframes)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stdc

BENCHMARK_MAIN();
