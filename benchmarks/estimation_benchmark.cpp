// Times the optimisers on a simulated room (Kinect-like noise, 7 % wrong pixels, 5 % wrong depths), beside
// Ceres with the same residuals, kernels, derivatives and stop rule. The counter `cost` is the robust cost
// reached: equal costs mean that equal work was done. What Ceres needs to build its problem is not counted.
// Use --benchmark_repetitions=9 --benchmark_report_aggregates_only=true for medians.
#include <benchmark/benchmark.h>

#include "estimation/test_synthetic_scene.hpp"

#if defined(STDC_HAVE_CERES)
#include "estimation/test_ceres_reference.hpp"
#endif

namespace stdc {
namespace {

constexpr double kStopAt = 1e-4;  // relative decrease of the cost

struct PoseTask {
  test::PoseScene scene;
  Pose initial;
};

/// Scenes with 2 cm and 0.02 rad of initial error per axis.
std::vector<PoseTask> pose_tasks(int observations) {
  std::vector<PoseTask> tasks;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    test::SceneOptions options;
    options.seed = seed;
    Random random(options.seed + 100);
    test::PoseScene scene = test::make_pose_scene(options, observations);
    const Pose initial = test::disturbed(scene.truth, random, 0.02, 0.02);
    tasks.push_back({std::move(scene), initial});
  }
  return tasks;
}

/// The whole function as the tracker calls it: up to four rounds.
void optimise_pose_in_rounds(benchmark::State& state) {
  const std::vector<PoseTask> tasks = pose_tasks(static_cast<int>(state.range(0)));
  std::size_t k = 0;
  for (auto _ : state) {
    const PoseTask& task = tasks[k++ % tasks.size()];
    benchmark::DoNotOptimize(
        optimise_pose(task.scene.camera, task.scene.observations, task.initial, task.scene.sigma, {}));
  }
}

test::BundleScene bundle_scene(const benchmark::State& state) {
  test::SceneOptions options;
  options.poses = static_cast<int>(state.range(0));
  options.fixed_poses = static_cast<int>(state.range(1));
  options.points = static_cast<int>(state.range(2));
  return test::make_scene(options);
}

void run_bundle(benchmark::State& state, const BundleSettings& settings) {
  const test::BundleScene scene = bundle_scene(state);
  BundleResult result;
  for (auto _ : state) {
    state.PauseTiming();
    BundleProblem problem = scene.problem;
    state.ResumeTiming();
    result = bundle_adjust(scene.camera, problem, scene.sigma, settings);
  }
  state.counters["cost"] = result.final_cost;
  state.counters["iterations"] = result.iterations;
  state.counters["observations"] = static_cast<double>(scene.problem.observations.size());
}

/// Both stages with the default settings, as the mapper calls it.
void bundle_in_stages(benchmark::State& state) { run_bundle(state, {}); }

/// One robust minimisation.
void bundle_once(benchmark::State& state) {
  BundleSettings settings;
  settings.robust_iterations = 100;
  settings.final_iterations = 0;
  settings.min_relative_decrease = kStopAt;
  run_bundle(state, settings);
}

#if defined(STDC_HAVE_CERES)

void pose_by_ceres(benchmark::State& state) {
  const std::vector<PoseTask> tasks = pose_tasks(static_cast<int>(state.range(0)));
  std::size_t k = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const PoseTask& task = tasks[k++ % tasks.size()];
    const auto model = test::ceres_reference::make_pose(task.scene.camera, task.scene.observations,
                                                        task.initial, task.scene.sigma);
    state.ResumeTiming();
    ceres::Solver::Summary summary;
    ceres::Solve(test::ceres_reference::options(ceres::DENSE_NORMAL_CHOLESKY, 100, kStopAt), &model->problem,
                 &summary);
  }
}

void bundle_by_ceres(benchmark::State& state) {
  const test::BundleScene scene = bundle_scene(state);
  const ceres::LinearSolverType solver = state.range(0) > 100 ? ceres::SPARSE_SCHUR : ceres::DENSE_SCHUR;
  ceres::Solver::Summary summary;
  for (auto _ : state) {
    state.PauseTiming();
    auto model = test::ceres_reference::make_bundle(scene.camera, scene.problem, scene.sigma);
    state.ResumeTiming();
    ceres::Solve(test::ceres_reference::options(solver, 100, kStopAt), &model->problem, &summary);
    state.PauseTiming();
    model.reset();
    state.ResumeTiming();
  }
  state.counters["cost"] = summary.final_cost;
  state.counters["iterations"] = static_cast<double>(summary.iterations.size()) - 1;
  state.counters["observations"] = static_cast<double>(scene.problem.observations.size());
}

#endif

/// Poses, fixed ones of them, points.
void local_sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({20, 10, 2000})->Args({30, 15, 3500})->Args({40, 20, 5000})->Unit(benchmark::kMillisecond);
}
void global_size(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({300, 1, 30000})->Iterations(1)->Unit(benchmark::kMillisecond);
}

BENCHMARK(optimise_pose_in_rounds)->Arg(300)->Arg(800)->Unit(benchmark::kMicrosecond);
BENCHMARK(bundle_in_stages)->Apply(local_sizes);
BENCHMARK(bundle_once)->Apply(local_sizes);
BENCHMARK(bundle_once)->Apply(global_size);
#if defined(STDC_HAVE_CERES)
BENCHMARK(pose_by_ceres)->Arg(300)->Arg(800)->Unit(benchmark::kMicrosecond);
BENCHMARK(bundle_by_ceres)->Apply(local_sizes);
BENCHMARK(bundle_by_ceres)->Apply(global_size);
#endif

}  // namespace
}  // namespace stdc

BENCHMARK_MAIN();
