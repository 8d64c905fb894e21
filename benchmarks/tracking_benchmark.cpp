// Times of tracking and mapping, step by step, on real frames and the maps grown of them. The frames are the
// first 300 of the sequence folder in the environment variable STDC_SEQUENCE (TUM layout); without it, 160 of
// the rendered static-desk. The column `CPU` is that of the one thread that does the work.
//
//     STDC_SEQUENCE=path/to/sequence build/release/tracking_benchmark
//
// The steps of tracking are timed on frames taken evenly from the footage, each with the map as it was then.
// The steps of mapping are timed on the footage's keyframes in turn, the map growing as it does in a run.
#include <benchmark/benchmark.h>

#include "moments.hpp"
#include "tracking/frame_matching.hpp"

namespace stdc {
namespace {

constexpr int kKeyframes = 20;  // timed by each benchmark of mapping

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
