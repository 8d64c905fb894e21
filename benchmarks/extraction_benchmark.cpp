// Times of the feature extraction and of its pieces, thread CPU time. The frames are those of the sequence
// folder in the environment variable STDC_SEQUENCE (TUM layout); without it, a synthetic picture of 640 x
// 480.
//
//     STDC_SEQUENCE=path/to/sequence build/release/extraction_benchmark
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/random.hpp"
#include "features/description/brief.hpp"
#include "features/detection/blur.hpp"
#include "features/detection/candidates.hpp"
#include "features/detection/fast.hpp"
#include "features/detection/harris.hpp"
#include "features/detection/pyramid.hpp"
#include "features/detection/quadtree.hpp"
#include "features/extractor.hpp"
#include "input/layouts/tum_sequence.hpp"

namespace stdc {
namespace {

cv::Mat synthetic_image() {
  Random random(1);
  cv::Mat image(480, 640, CV_8UC1, cv::Scalar(120));
  for (int i = 0; i < 1500; ++i) {
    const cv::Point corner(static_cast<int>(random.below(640)), static_cast<int>(random.below(480)));
    const cv::Size size(3 + static_cast<int>(random.below(40)), 3 + static_cast<int>(random.below(40)));
    cv::rectangle(image, {corner, size}, cv::Scalar(random.uniform(20, 235)), cv::FILLED);
  }
  cv::GaussianBlur(image, image, {}, 0.8);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      image.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>(image.at<std::uint8_t>(y, x) + 2 * random.normal());
    }
  }
  return image;
}

std::vector<cv::Mat> load_images() {
  constexpr std::size_t kMax = 60;
  const char* folder = std::getenv("STDC_SEQUENCE");
  if (folder == nullptr) return {synthetic_image()};
  const TumSequence sequence(folder);
  const Camera camera = find_camera(sequence, {});
  const std::size_t step = std::max<std::size_t>(1, sequence.frames().size() / kMax);
  std::vector<cv::Mat> images;
  for (std::size_t i = 0; i < sequence.frames().size(); i += step) {
    cv::Mat image = load_frame(sequence.frames()[i], camera).colour;
    if (image.channels() == 3) cv::cvtColor(image, image, cv::COLOR_BGR2GRAY);
    images.push_back(image);
  }
  return images;
}

const std::vector<cv::Mat>& images() {
  static const std::vector<cv::Mat> loaded = load_images();
  return loaded;
}

/// The frames in turn.
class Frames {
 public:
  Frames() { images(); }  // loads them before the timer starts
  const cv::Mat& next() { return images()[next_++ % images().size()]; }

 private:
  std::size_t next_ = 0;
};

/// What the pieces work on: pyramids and corners of the frames.
struct Prepared {
  Pyramid pyramid;
  std::vector<std::vector<Corner>> corners;
};

const std::vector<Prepared>& prepared() {
  static const std::vector<Prepared> all = [] {
    std::vector<Prepared> result;
    const FeatureSettings settings;
    for (const cv::Mat& image : images()) {
      Prepared& p = result.emplace_back();
      p.pyramid.build(image, settings);
      for (int i = 0; i < p.pyramid.levels(); ++i) {
        find_fast_corners(p.pyramid.level(i).view(), kBorder, settings.threshold_low,
                          p.corners.emplace_back());
      }
    }
    return result;
  }();
  return all;
}

void extract(benchmark::State& state, Selection selection) {
  FeatureExtractor extractor({.selection = selection, .keypoints = static_cast<int>(state.range(0))});
  Frames frames;
  for (auto _ : state) benchmark::DoNotOptimize(extractor.extract(frames.next()));
}
BENCHMARK_CAPTURE(extract, improved, Selection::improved)
    ->Arg(1000)
    ->Arg(2000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(extract, orb_slam3, Selection::orb_slam3)->Arg(1000)->Unit(benchmark::kMillisecond);

void detect(benchmark::State& state) {
  FeatureExtractor extractor;
  Frames frames;
  for (auto _ : state) extractor.detect(frames.next());
}
BENCHMARK(detect)->Unit(benchmark::kMillisecond);

void select(benchmark::State& state, bool masked) {
  FeatureExtractor extractor;
  cv::Mat mask;
  if (masked) {
    mask = cv::Mat::zeros(images()[0].size(), CV_8UC1);
    mask(cv::Rect(mask.cols / 3, mask.rows / 5, mask.cols / 3, mask.rows * 4 / 5)) = 255;
  }
  extractor.detect(images()[images().size() / 2]);
  for (auto _ : state) {
    extractor.reject(mask);
    benchmark::DoNotOptimize(extractor.select());
  }
}
BENCHMARK_CAPTURE(select, all, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(select, masked, true)->Unit(benchmark::kMillisecond);

void pyramid(benchmark::State& state) {
  Pyramid levels;
  Frames frames;
  for (auto _ : state) levels.build(frames.next(), FeatureSettings());
}
BENCHMARK(pyramid)->Unit(benchmark::kMillisecond);

void fast(benchmark::State& state) {
  std::vector<Corner> corners;
  std::size_t frame = 0, found = 0;
  prepared();  // before the timer starts
  for (auto _ : state) {
    const Prepared& p = prepared()[frame++ % prepared().size()];
    for (int i = 0; i < p.pyramid.levels(); ++i) {
      find_fast_corners(p.pyramid.level(i).view(), kBorder, static_cast<int>(state.range(0)), corners);
      found += corners.size();
    }
  }
  state.counters["corners"] =
      benchmark::Counter(static_cast<double>(found), benchmark::Counter::kAvgIterations);
}
BENCHMARK(fast)->Arg(7)->Arg(20)->Unit(benchmark::kMillisecond);

void blur(benchmark::State& state) {
  PaddedImage smoothed;
  std::size_t frame = 0;
  prepared();  // before the timer starts
  for (auto _ : state) {
    const Prepared& p = prepared()[frame++ % prepared().size()];
    for (int i = 0; i < p.pyramid.levels(); ++i) gaussian_blur(p.pyramid.level(i).view(), smoothed);
  }
}
BENCHMARK(blur)->Unit(benchmark::kMillisecond);

void choose_and_distribute(benchmark::State& state, Selection selection) {
  const FeatureSettings settings{.selection = selection};
  CandidateChooser chooser;
  Quadtree tree;
  std::size_t frame = 0;
  prepared();  // before the timer starts
  for (auto _ : state) {
    const Prepared& p = prepared()[frame++ % prepared().size()];
    const std::vector<int> budgets = level_budgets(settings, p.pyramid.sizes());
    for (int i = 0; i < p.pyramid.levels(); ++i) {
      const auto level = static_cast<std::size_t>(i);
      const cv::Size size = p.pyramid.sizes()[level];
      const Cell area{kBorder, kBorder, size.width - kBorder, size.height - kBorder};
      const auto& candidates = chooser.choose(p.corners[level], area, budgets[level], settings);
      benchmark::DoNotOptimize(tree.select(candidates, area, budgets[level], selection));
    }
  }
}
BENCHMARK_CAPTURE(choose_and_distribute, improved, Selection::improved)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(choose_and_distribute, orb_slam3, Selection::orb_slam3)->Unit(benchmark::kMillisecond);

void harris(benchmark::State& state) {
  const Prepared& p = prepared()[0];
  std::size_t i = 0;
  for (auto _ : state) {
    const Corner& corner = p.corners[0][i++ % p.corners[0].size()];
    benchmark::DoNotOptimize(harris_response(p.pyramid.level(0).view(), corner.x, corner.y));
  }
}
BENCHMARK(harris);

void orientation(benchmark::State& state) {
  const Prepared& p = prepared()[0];
  std::size_t i = 0;
  for (auto _ : state) {
    const Corner& corner = p.corners[0][i++ % p.corners[0].size()];
    const PatchMoments moments = patch_moments(p.pyramid.level(0).view(), corner.x, corner.y);
    benchmark::DoNotOptimize(angle_of(moments));
  }
}
BENCHMARK(orientation);

void brief(benchmark::State& state) {
  const Prepared& p = prepared()[0];
  const SteeredBrief descriptor;
  std::size_t i = 0;
  for (auto _ : state) {
    const Corner& corner = p.corners[0][i++ % p.corners[0].size()];
    const ImageView image = p.pyramid.level(0).view();
    const Direction direction = direction_of({corner.x - 320, corner.y - 240});
    benchmark::DoNotOptimize(descriptor.describe(image, corner.x, corner.y, direction));
  }
}
BENCHMARK(brief);

}  // namespace
}  // namespace stdc

BENCHMARK_MAIN();
