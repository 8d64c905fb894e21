// Closing a loop over hundreds of keyframes, and the full bundle adjustment after it, on a simulated circle.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "atlas/test_scene.hpp"
#include "loop_closing/full_bundle.hpp"
#include "loop_closing/loop_correction.hpp"
#include "place_recognition/place_recogniser.hpp"

namespace stdc {
namespace {

constexpr double kRadius = 20, kWall = 23;  // [m] the cameras go round within a round wall and look at it
constexpr int kAgain = 12;                  // keyframes of the second round

/// A wall around the origin with about as many points in a view as a real one has.
test::Scene round_wall() {
  test::Scene scene(0);
  Random random(3);
  constexpr int kPoints = 12000;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = random.uniform(0.0, 2 * std::numbers::pi);
    test::ScenePoint point;
    point.position = {kWall * std::sin(angle), random.uniform(-1.2, 1.2), kWall * std::cos(angle)};
    point.descriptor = test::random_descriptor(random);
    point.angle = static_cast<float>(random.uniform(-3.1, 3.1));
    point.size_level = random.uniform(0.0, 4.0);
    scene.points.push_back(point);
  }
  return scene;
}

/// Once around and a little more. What is seen again is not recognised, and the map has drifted by then.
struct Round {
  test::MappedScene mapped{round_wall()};
  KeyframeId current, matched;

  explicit Round(int keyframes) {
    Vector6d drift_per_keyframe;
    drift_per_keyframe << 1.0, -0.6, 0.8, 0.02, 0.03, -0.02;
    drift_per_keyframe *= 0.3 / keyframes;
    std::vector<LandmarkId> again(mapped.scene.points.size());
    for (int k = 0; k < keyframes + kAgain; ++k) {
      const double angle = 2 * std::numbers::pi * k / keyframes;
      test::ViewOptions options;
      options.depth_noise = 0.003;
      options.pixel_noise = 0.4;
      options.seed = static_cast<std::uint64_t>(k) + 1;
      test::View view = mapped.scene.look(
          test::camera_at(kRadius * std::sin(angle), 0, kRadius * std::cos(angle), 0, angle), options);
      const Pose drift = Pose::exp(k * drift_per_keyframe);
      view.cam_from_world = view.cam_from_world * drift.inverse();
      add(view, drift, k < keyframes - kAgain ? mapped.landmarks : again, k >= keyframes - kAgain);
    }
    current = {static_cast<std::uint32_t>(keyframes + kAgain - 1)};
    matched = {static_cast<std::uint32_t>(kAgain - 1)};
  }

  /// @param again  points that the first keyframes saw are taken for new ones
  void add(const test::View& view, const Pose& drift, std::vector<LandmarkId>& table, bool again) {
    Atlas& atlas = mapped.atlas;
    const KeyframeId id = mapped.add_bare(view);
    for (int i = 0; i < view.features->size(); ++i) {
      const int point = view.points[i];
      const LandmarkId known = mapped.landmarks[point];
      const bool recent = known.valid() && atlas.landmark(known).created_by.value > 4 * kAgain;
      LandmarkId& landmark = again && recent ? mapped.landmarks[point] : table[point];
      if (!landmark.valid()) landmark = atlas.add_landmark(drift * mapped.scene.points[point].position, id);
      atlas.observe(id, i, landmark);
      atlas.refresh(landmark);
    }
    atlas.update_covisibility(id);
  }
  LoopTools tools() const { return {{mapped.scene.camera, {}}, {}, {}, {}}; }
  VerifiedLoop loop() const {
    const auto found = verify_loop({{mapped.scene.camera, {}}, {}}, mapped.atlas, current, matched, {});
    if (!found) throw std::runtime_error("the loop is not found");
    return *found;
  }
};

void close_loop(benchmark::State& state) {
  for (auto step : state) {
    state.PauseTiming();
    Round round(static_cast<int>(state.range(0)));
    const VerifiedLoop loop = round.loop();
    state.ResumeTiming();
    const LoopReport done = close_loop(round.tools(), round.mapped.atlas, loop);
    state.counters["keyframes"] = done.keyframes;
    state.counters["landmarks"] = round.mapped.atlas.landmark_count();
    state.counters["fused"] = done.fused;
    state.counters["drift_m"] = done.drift;
  }
}
BENCHMARK(close_loop)->Arg(100)->Arg(500)->Unit(benchmark::kMillisecond)->MinTime(0.01);

void verify_loop(benchmark::State& state) {
  const Round round(100);
  for (auto step : state) benchmark::DoNotOptimize(round.loop());
}
BENCHMARK(verify_loop)->Unit(benchmark::kMillisecond);

void full_bundle(benchmark::State& state) {
  for (auto step : state) {
    state.PauseTiming();
    Round round(static_cast<int>(state.range(0)));
    close_loop(round.tools(), round.mapped.atlas, round.loop());
    FullBundle bundle(round.mapped.atlas, {0});
    state.ResumeTiming();
    bundle.solve({round.mapped.scene.camera, {}}, {10, 10, 1e-4});
    state.counters["observations"] = bundle.observations();
  }
}
BENCHMARK(full_bundle)->Arg(100)->Arg(500)->Unit(benchmark::kMillisecond)->MinTime(0.01);

void copy_and_apply_full_bundle(benchmark::State& state) {
  Round round(static_cast<int>(state.range(0)));
  FullBundle solved(round.mapped.atlas, {0});
  solved.solve({round.mapped.scene.camera, {}}, {1, 0, 1e-4});
  for (auto step : state) {
    const FullBundle copy(round.mapped.atlas, {0});
    benchmark::DoNotOptimize(copy.observations());
    solved.apply(round.mapped.atlas);
  }
}
BENCHMARK(copy_and_apply_full_bundle)->Arg(500)->Unit(benchmark::kMillisecond)->MinTime(0.01);

void recognise_place(benchmark::State& state) {
  const Round round(static_cast<int>(state.range(0)));
  PlaceRecogniser places({round.tools().sensor, {}}, {});
  places.add_all(round.mapped.atlas);
  const test::View& view = round.mapped.views[30];
  for (auto step : state)
    benchmark::DoNotOptimize(places.locate(round.mapped.atlas, {*view.features, view.motion}));
}
BENCHMARK(recognise_place)->Arg(500)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stdc

BENCHMARK_MAIN();
