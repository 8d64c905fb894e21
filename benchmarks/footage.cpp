#include "footage.hpp"

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "input/layouts/tum_sequence.hpp"
#include "simulation/sequence/rendered_sequence.hpp"

namespace stdc {
namespace {

constexpr std::size_t kMaxRead = 300;  // 0.9 MB each
constexpr int kRendered = 160;         // some 10 a second

Footage read(const char* folder) {
  const TumSequence sequence(folder);
  Footage footage{find_camera(sequence, {}), {}};
  const std::size_t count = std::min(kMaxRead, sequence.frames().size());
  for (std::size_t i = 0; i < count; ++i) {
    footage.frames.push_back(load_frame(sequence.frames()[i], footage.camera, ColourMode::grey));
  }
  return footage;
}

Footage render() {
  const simulation::RenderedSequence sequence(simulation::Preset::static_desk, {});
  Footage footage{sequence.camera(), std::vector<RgbdImage>(kRendered)};
  const int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::jthread> workers;
  workers.reserve(static_cast<std::size_t>(threads));
  for (int first = 0; first < threads; ++first) {
    workers.emplace_back([&, first] {
      for (int i = first; i < kRendered; i += threads) {
        RgbdImage image = sequence.render(i).image;
        cv::Mat grey;
        cv::cvtColor(image.colour, grey, cv::COLOR_BGR2GRAY);
        image.colour = grey;
        footage.frames[static_cast<std::size_t>(i)] = image;
      }
    });
  }
  workers.clear();  // waits
  return footage;
}

}  // namespace

Footage load_footage() {
  const char* folder = std::getenv("STDC_SEQUENCE");
  return folder != nullptr ? read(folder) : render();
}

}  // namespace stdc
