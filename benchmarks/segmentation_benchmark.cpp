// Times of the refinement and the propagation of masks, thread CPU time. The frames are those of the rendered
// sequence folder in the environment variable STDC_MASKED_SEQUENCE (TUM layout with mask/), at most 300;
// without it, rendered frames of walking-static.
//
//     STDC_MASKED_SEQUENCE=path/to/sequence build/release/segmentation_benchmark
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/random.hpp"
#include "masked_footage.hpp"
#include "segmentation/propagation/mask_propagator.hpp"
#include "segmentation/propagation/mask_settling.hpp"
#include "segmentation/srm/refinement.hpp"
#include "simulation/sequence/rendered_sequence.hpp"

namespace stdc {
namespace {

constexpr double kUnits = 5000;

const std::vector<MaskedFrame>& frames() {
  static const std::vector<MaskedFrame> loaded = load_masked_footage();
  return loaded;
}

/// The masks as a network gives them: a little too small.
const std::vector<cv::Mat>& masks() {
  static const std::vector<cv::Mat> eroded = [] {
    std::vector<cv::Mat> result;
    for (const MaskedFrame& frame : frames())
      cv::erode(frame.mask, result.emplace_back(), cv::Mat(), {-1, -1}, 5);
    return result;
  }();
  return eroded;
}

void refine_people(benchmark::State& state, bool metres) {
  std::vector<cv::Mat> depths;
  double share = 0;
  for (const MaskedFrame& frame : frames()) {
    frame.depth.convertTo(depths.emplace_back(), metres ? CV_32F : CV_16U, metres ? 1 / kUnits : 1);
    share += static_cast<double>(cv::countNonZero(frame.mask)) / static_cast<double>(frame.mask.total());
  }
  std::size_t i = 0;
  cv::Mat refined;
  masks();  // before the watch starts
  for (auto _ : state) {
    refine(masks()[i], depths[i], kUnits, {}, refined);
    i = (i + 1) % depths.size();
  }
  state.counters["share"] = share / static_cast<double>(depths.size());
}
BENCHMARK_CAPTURE(refine_people, units, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(refine_people, metres, true)->Unit(benchmark::kMillisecond);

/// Nothing can be settled by the extremes: claimants far and near, all other pixels between them.
void refine_worst(benchmark::State& state) {
  Random random(1);
  cv::Mat mask(480, 640, CV_8UC1), depth(480, 640, CV_16UC1);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const bool dynamic = random.below(10) == 0;
      mask.at<std::uint8_t>(y, x) = dynamic ? 255 : 0;
      const std::uint32_t far_or_near = 5000 + 20000 * random.below(2);
      depth.at<std::uint16_t>(y, x) =
          static_cast<std::uint16_t>(dynamic ? far_or_near : 15000 + random.below(99));
    }
  }
  cv::Mat refined;
  for (auto _ : state) refine(mask, depth, kUnits, {}, refined);
}
BENCHMARK(refine_worst)->Unit(benchmark::kMillisecond);

void settle(benchmark::State& state) {
  std::size_t i = 0;
  masks();  // before the watch starts
  for (auto _ : state) {
    benchmark::DoNotOptimize(settle_by_depth(masks()[i], frames()[i].depth, kUnits));
    i = (i + 1) % frames().size();
  }
}
BENCHMARK(settle)->Unit(benchmark::kMillisecond);

/// What every frame costs when a mask comes `delay` frames late for each `delay`-th frame.
void propagate(benchmark::State& state) {
  const int delay = static_cast<int>(state.range(0));
  MaskPropagator propagator(simulation::default_render_camera());
  int number = 0;
  const auto at = [&](int frame) -> const MaskedFrame& {
    return frames()[static_cast<std::size_t>(frame) % frames().size()];
  };
  frames();  // before the watch starts
  for (auto _ : state) {
    propagator.add_frame(number, at(number).grey, at(number).depth);
    if (number >= delay && number % delay == 0) propagator.set_mask(number - delay, at(number - delay).mask);
    benchmark::DoNotOptimize(propagator.mask());
    ++number;
  }
}
BENCHMARK(propagate)->Arg(1)->Arg(3)->Arg(6)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stdc

BENCHMARK_MAIN();
