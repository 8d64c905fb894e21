// What it costs to make a frame of a recording ready: registering depth to colour.
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>

#include "input/registration/depth_registration.hpp"

namespace stdc {
namespace {

Camera camera_of(int width, int height, double focal) {
  Camera camera;
  camera.width = width, camera.height = height, camera.fx = camera.fy = focal;
  camera.cx = 0.5 * (width - 1), camera.cy = 0.5 * (height - 1);
  camera.depth_units_per_metre = 1000;
  return camera;
}

/// A room with steps of depth and holes, as a camera at its middle sees it.
cv::Mat room(const Camera& camera) {
  cv::Mat depth(camera.height, camera.width, CV_16UC1, cv::Scalar(3000));
  for (int i = 0; i < 12; ++i) {
    const cv::Rect box(i * camera.width / 12, (i * 5 % 7) * camera.height / 9, camera.width / 15,
                       camera.height / 5);
    depth(box).setTo(i % 4 == 3 ? 0 : 900 + 150 * i);
  }
  return depth;
}

/// As between the imagers of a RealSense D435; arguments: depth size, colour size, whether colour has a lens.
void register_depth(benchmark::State& state) {
  const auto at = [&](int i) { return static_cast<int>(state.range(i)); };
  DepthCamera depth;
  depth.camera = camera_of(at(0), at(1), 0.5 * at(0));
  depth.colour_from_depth.translation = {0.015, 0, 0};
  depth.colour_from_depth.rotation = rotation_exp({0.002, -0.004, 0.001});
  Camera colour = camera_of(at(2), at(3), 0.96 * at(2));
  if (at(4) != 0) colour.k1 = 0.12, colour.k2 = -0.25, colour.p1 = 1e-3;
  const DepthRegistration registration(depth, colour);
  const cv::Mat image = room(depth.camera);
  for (auto _ : state) benchmark::DoNotOptimize(registration.apply(image));
}
BENCHMARK(register_depth)
    ->Args({848, 480, 640, 480, 0})
    ->Args({848, 480, 640, 480, 1})
    ->Args({640, 480, 640, 480, 1})
    ->Args({1280, 720, 1920, 1080, 1})
    ->Args({256, 192, 1920, 1440, 0})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stdc

BENCHMARK_MAIN();
