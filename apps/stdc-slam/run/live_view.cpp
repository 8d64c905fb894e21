#include "run/live_view.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "core/error.hpp"

namespace stdc::app {
namespace {

ViewOptions server_options(const LiveViewOptions& options) {
  constexpr int kMaxPort = 65535;
  if (*options.port < 0 || *options.port > kMaxPort) {
    throw Error("--view", fmt::format("{} is not a port", *options.port),
                "give 1 to 65535, or 0 for any that is free");
  }
  ViewOptions server;
  server.address.port = *options.port;
  if (options.address) server.address.host = *options.address;
  return server;
}

ViewSubject subject_of(const SequenceInput& input, const Settings& settings, bool realtime) {
  ViewSubject subject;
  subject.name = input.name;
  subject.camera = input.camera;
  subject.expected_frames = input.expected_frame_count();
  subject.can_pause = !realtime && input.source().can_rewind();
  subject.has_network = settings.segmentation.source != SegmentationSource::off;
  subject.has_motion = settings.motion.method != MotionMethod::off;
  subject.has_dense = settings.dense.active;
  subject.version = STDC_VERSION;
  return subject;
}

/// The truth, where it is at hand before the frames are read.
std::optional<Trajectory> early_truth(const SequenceInput& input) {
  if (input.source().truth_comes_last()) return std::nullopt;
  return input.truth();
}

/// Where the run reads grey, what the page shows is decoded again, in colour, by the thread that draws it.
std::function<cv::Mat()> colour_of(const ObservedFrame& frame) {
  if (frame.image == nullptr || frame.image->colour.channels() != 1 || !frame.packed) return {};
  return [packed = frame.packed, size = frame.image->colour.size()] {
    return packed->colour(size, ColourMode::as_stored);
  };
}

}  // namespace

LiveView::LiveView(const LiveViewOptions& options, const SequenceInput& input, const Settings& slam_settings,
                   bool realtime, bool quiet, const InterruptWatch& interrupts)
    : options_(options),
      interrupts_(interrupts),
      server_(server_options(options), subject_of(input, slam_settings, realtime)) {
  if (auto truth = early_truth(input)) server_.set_truth(*std::move(truth));
  // A link with a token is of no use unless it is told.
  if (quiet && !options.address) return;
  fmt::print(stderr, "stdc-slam: live view at {}\n", server_.link());
  std::fflush(stderr);
}

void LiveView::begin(std::function<const Slam&()> slam) {
  slam_ = std::move(slam);
  if (options_.wait) server_.wait_for_page([this] { return interrupts_.interrupted(); });
}

void LiveView::on_frame(const ObservedFrame& frame) {
  server_.show(
      frame.image, frame.result, slam_(), [this] { return interrupts_.interrupted(); }, colour_of(frame));
}

void LiveView::on_end(const std::vector<LoopReport>& loops) { server_.finish(slam_(), loops); }

}  // namespace stdc::app
