// The segmentation network of full width; how long it takes does not depend on the weights, which are random.
// STDC_NETWORK_STEPS=1 in the environment also prints the time of each step of a 512 x 384 image to stderr.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "segmentation/network/network_segmenter.hpp"
#include "segmentation/network/test_random_weights.hpp"
#include "segmentation/network/weights_reader.hpp"

namespace stdc {
namespace {

const NetworkWeights& weights_of(bool stdc2) {
  static const NetworkWeights one = test::RandomWeights(false).read(), two = test::RandomWeights(true).read();
  return stdc2 ? two : one;
}

cv::Mat noise(cv::Size size) {
  Random random(1);
  cv::Mat image(size, CV_8UC3);
  for (int y = 0; y < image.rows; ++y) {
    for (int i = 0; i < 3 * image.cols; ++i) image.ptr(y)[i] = static_cast<std::uint8_t>(random.below(256));
  }
  return image;
}

void print_steps(StdcNetwork& network) {
  std::vector<double> min_times = network.profile();
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> again = network.profile();
    std::transform(min_times.begin(), min_times.end(), again.begin(), min_times.begin(),
                   [](double a, double b) { return std::min(a, b); });
  }
  for (std::size_t i = 0; i < min_times.size(); ++i) {
    const NetworkStep& step = network.steps()[i];
    std::fprintf(stderr, "%-42s %-24s %8.3f ms %7.1f million multiplications\n", step.name.c_str(),
                 step.kernel.c_str(), min_times[i], step.multiplications * 1e-6);
  }
}

void network(benchmark::State& state, bool stdc2, NetworkPrecision precision) {
  const cv::Size size(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  StdcNetwork net(weights_of(stdc2), size, precision);
  const cv::Mat image = noise(size);
  for (auto _ : state) benchmark::DoNotOptimize(net.run(image));
  double count = 0;
  for (const NetworkStep& step : net.steps()) count += step.multiplications;
  state.counters["million_multiplications"] = count * 1e-6;
  if (std::getenv("STDC_NETWORK_STEPS") != nullptr && size.width == 512) print_steps(net);
}

/// What comes before and after: 640 x 480 to the network's size, and its logits to a mask.
void segment(benchmark::State& state, NetworkPrecision precision) {
  NetworkSegmenter segmenter(weights_of(false), {precision, 1, 512, 384});
  const cv::Mat image = noise({640, 480});
  for (auto _ : state) benchmark::DoNotOptimize(segmenter.segment({image, 0, 0}));
}

void class_map(benchmark::State& state) {
  const int classes = static_cast<int>(state.range(0));
  std::vector<bool> dynamic(static_cast<std::size_t>(classes), false);
  dynamic.back() = true;
  ClassMap map({64, 48}, {640, 480}, dynamic);
  // Blobs of eight logits across: a person's outline, not noise.
  std::vector<float> planes(static_cast<std::size_t>(classes) * 64 * 48);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const std::size_t x = i % 64 / 8, y = i / 64 % 48 / 8, k = i / (64 * 48);
    planes[i] = static_cast<float>((x * 7 + y * 3 + k * 5) % 11);
  }
  for (auto _ : state) benchmark::DoNotOptimize(map.draw({planes, classes, 48, 64}));
}

void load(benchmark::State& state, NetworkPrecision precision) {
  for (auto _ : state) StdcNetwork(weights_of(false), {512, 384}, precision);
}

/// From the file of the weights that ship to a network that is ready; without one: only the file.
void start(benchmark::State& state, const char* variant, bool with_network) {
  const std::filesystem::path file = find_network_weights(variant);
  for (auto _ : state) {
    const NetworkWeights weights = read_network_weights(file);
    if (with_network) NetworkSegmenter(weights, {});
  }
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({640, 480})->Args({512, 384})->Args({320, 224})->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(network, stdc1_fp32, false, NetworkPrecision::fp32)->Apply(sizes);
BENCHMARK_CAPTURE(network, stdc1_int8, false, NetworkPrecision::int8)->Apply(sizes);
BENCHMARK_CAPTURE(network, stdc2_fp32, true, NetworkPrecision::fp32)->Apply(sizes);
BENCHMARK_CAPTURE(network, stdc2_int8, true, NetworkPrecision::int8)->Apply(sizes);
BENCHMARK_CAPTURE(segment, fp32, NetworkPrecision::fp32)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(segment, int8, NetworkPrecision::int8)->Unit(benchmark::kMillisecond);
BENCHMARK(class_map)->Arg(2)->Arg(19)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(start, slim_read, "slim", false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(start, slim, "slim", true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(start, wide_read, "wide", false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(start, wide, "wide", true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load, fp32, NetworkPrecision::fp32)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(load, int8, NetworkPrecision::int8)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stdc

BENCHMARK_MAIN();
