#include "run/track_frames.hpp"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "core/error.hpp"
#include "core/stopwatch.hpp"
#include "run/frame_loader.hpp"
#include "run/process_usage.hpp"
#include "run/progress.hpp"

namespace stdc::app {
namespace {

/// Reports what could not be used, the first faults each with a line.
class FaultReport {
 public:
  explicit FaultReport(Progress& progress) : progress_(progress) {}
  ~FaultReport() {
    if (count_ > kMax) progress_.message(fmt::format("stdc-slam: {} more faults", count_ - kMax));
  }
  FaultReport(const FaultReport&) = delete;
  FaultReport& operator=(const FaultReport&) = delete;

  void add(int frame, const std::string& fault, const char* outcome) {
    if (++count_ <= kMax) progress_.message(fmt::format("stdc-slam: {}; frame {} {}", fault, frame, outcome));
  }

 private:
  static constexpr int kMax = 20;
  Progress& progress_;
  int count_ = 0;
};

/// Gives frames out at the times at which a camera would.
class Pacer {
 public:
  explicit Pacer(bool active) : active_(active) {}

  void wait_for(double timestamp) {
    if (!active_) return;
    if (first_ == 0) {
      first_ = timestamp;
      start_ = Clock::now();
    }
    const std::chrono::duration<double> since_first(timestamp - first_);
    release_ = start_ + std::chrono::duration_cast<Clock::duration>(since_first);
    std::this_thread::sleep_until(release_);
  }
  /// Milliseconds since the camera gave the frame of the last wait_for().
  std::optional<double> lag_ms() const {
    if (!active_) return std::nullopt;
    return std::chrono::duration<double, std::milli>(Clock::now() - release_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool active_;
  double first_ = 0;
  Clock::time_point start_, release_;
};

/// What came to light while the frames were read. Throws Error if there was none.
void check_end(const SequenceInput& input, int frames, Progress& progress) {
  for (const std::string& fault : input.source().faults()) progress.message("stdc-slam: " + fault);
  const std::optional<int> end = input.end_frame();
  if (frames > 0 && (!end || input.first_frame() + frames >= *end)) return;
  const std::string found = fmt::format("ends before frame {}", input.first_frame() + frames);
  if (frames == 0) {
    throw Error(input.source().where(), input.first_frame() == 0 ? "holds no frame" : found,
                "stdc-slam info shows what is in it");
  }
  progress.message(
      fmt::format("stdc-slam: {}: {}; --frames asks for {}", input.source().where(), found, *end));
}

}  // namespace

std::optional<LoadedFrame> next_frame(const SequenceInput& input, FrameLoader& loader,
                                      const InterruptWatch& interrupts) {
  constexpr std::chrono::milliseconds kPatience(50);
  if (!input.source().is_live()) return loader.next();
  do {
    if (interrupts.take()) input.stop();
  } while (!loader.wait(kPatience));
  return loader.next();
}

void track_frames(const SequenceInput& input, const TrackOptions& options, const InterruptWatch& interrupts,
                  Slam& slam, RunRecord& record, std::span<FrameObserver* const> observers) {
  FrameLoader loader(input, options.colour);
  Progress progress(options.label, "frames", input.expected_frame_count(), options.quiet);
  FaultReport faults(progress);
  Pacer pacer(options.realtime);
  Stopwatch stopwatch;
  while (const auto frame = next_frame(input, loader, interrupts)) {
    const int number = input.first_frame() + frame->index;
    // Then the camera or the whole sequence is wrong.
    if (frame->error && frame->index == 0) throw *frame->error;
    if (frame->error) faults.add(number, frame->error->what(), "is skipped");
    pacer.wait_for(frame->timestamp);
    const TrackingResult result = frame->image ? slam.track(*frame->image) : slam.skip(frame->timestamp);
    record.add(result, pacer.lag_ms());
    if (result.segmentation && !result.segmentation->problem.empty()) {
      faults.add(number, result.segmentation->problem, "has no mask of its own");
    }
    if (frame->index == 0) record.set_start_up_seconds(process_usage().wall_seconds);
    for (FrameObserver* observer : observers) {
      observer->on_frame({number, frame->image ? &*frame->image : nullptr, result, frame->packed});
    }
    if (!input.source().is_live() && interrupts.interrupted()) {
      // Said here, because the signal ends the program as soon as the watch is gone.
      const auto count = input.frame_count();
      progress.message(fmt::format("stdc-slam: interrupted after {}{} frames; nothing was written",
                                   frame->index + 1, count ? fmt::format(" of {}", *count) : ""));
      throw Error("interrupted", "nothing was written", "start again, perhaps with --frames");
    }
    progress.update(frame->index + 1);
  }
  check_end(input, record.counts().total(), progress);
  const std::vector<LoopReport> loops = slam.finish();
  for (const LoopReport& loop : loops) record.add(loop);
  record.set_processing_seconds(1e-3 * stopwatch.lap_ms());
  for (FrameObserver* observer : observers) observer->on_end(loops);
}

}  // namespace stdc::app
