// What scripts/python_cost compares Python with: tracks a recording and prints the milliseconds of each call
// of track(), wall and CPU, and those of them that are not of the tracking itself; one call a line.
//   track_loop INPUT FRAMES
#include <fmt/format.h>

#include <iostream>
#include <string>

#include "core/error.hpp"
#include "core/stopwatch.hpp"
#include "input/frame_decoder.hpp"
#include "input/open_source.hpp"
#include "slam/slam.hpp"

int main(int count, char** arguments) try {
  if (count != 3) {
    std::cerr << "usage: track_loop INPUT FRAMES\n";
    return 2;
  }
  const auto source = stdc::open_source(arguments[1]);
  const stdc::RgbdCameras cameras = source->cameras().value();
  stdc::Settings settings;
  settings.segmentation.source = stdc::SegmentationSource::off;
  settings.motion.method = stdc::MotionMethod::off;
  stdc::Slam slam(cameras.colour, settings);
  const stdc::FrameDecoder decoder(cameras);
  const int frames = std::stoi(arguments[2]);
  for (int i = 0; i < frames; ++i) {
    const auto frame = source->next();
    if (!frame) break;
    const stdc::RgbdImage image = decoder.decode(*frame, stdc::ColourMode::as_stored);
    const double cpu = stdc::thread_cpu_ms();
    stdc::Stopwatch stopwatch;
    const stdc::TrackingResult result = slam.track(image);
    const double wall = stopwatch.lap_ms(), spent = stdc::thread_cpu_ms() - cpu;
    const stdc::StageTimes& inside = result.milliseconds;
    std::cout << fmt::format("{:.4f} {:.4f} {:.4f} {:.4f}\n", wall, spent, wall - inside.total,
                             spent - inside.total_cpu);
  }
  slam.finish();
} catch (const stdc::Error& error) {
  std::cerr << error.what() << "\n";
  return 2;
}
