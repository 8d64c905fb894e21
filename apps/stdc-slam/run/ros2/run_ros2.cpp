#include "run/ros2/run_ros2.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <opencv2/core/utility.hpp>
#include <thread>

#include "core/error.hpp"
#include "run/frame_loader.hpp"
#include "run/interrupt_watch.hpp"
#include "run/live_view.hpp"
#include "run/progress.hpp"
#include "run/ros2/ros2_camera.hpp"
#include "run/ros2/ros2_session.hpp"
#include "run/run_checks.hpp"
#include "run/sequence_input.hpp"
#include "run/track_frames.hpp"

namespace stdc::app {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kTick(50);

Settings ros2_settings(const Ros2Options& options) {
  Settings settings = chosen_settings(options.settings, options.segmentation);
  check_not_assigned(options.localisation_only, "--localisation-only", options.settings,
                     "system.localisation_only");
  SystemSettings& system = settings.system;
  system.localisation_only = system.localisation_only || options.localisation_only;
  system.report_masks = system.report_masks || options.publish_mask;
  system.report_keypoints = system.report_keypoints || options.publish_debug_image;
  if (settings.segmentation.source == SegmentationSource::masks) {
    throw Error("--segmentation", "masks of files belong to a sequence", "choose network or off");
  }
  settings.validate();
  return settings;
}

/// /tf_static comes soon after the images, if it comes.
void find_mount(const Ros2Options& options, Ros2Session& session, const InterruptWatch& interrupts) {
  constexpr std::chrono::seconds kPatienceForMount(2);
  const Clock::time_point end = Clock::now() + kPatienceForMount;
  while (!session.find_mount()) {
    if (Clock::now() < end && !interrupts.interrupted()) {
      std::this_thread::sleep_for(kTick);
      continue;
    }
    fmt::print(
        stderr,
        "stdc-slam: /tf_static does not say where the camera is on {}: it is taken to be there, looking "
        "forward; name another frame by --base-frame\n",
        options.names.base);
    return session.assume_mount();
  }
}

void track_all(const SequenceInput& input, const Settings& settings, const Ros2Options& options,
               const InterruptWatch& interrupts, Ros2Session& session) {
  FrameLoader loader(input, colour_mode(settings));
  Progress progress("tracking", "frames", input.frame_count(), options.quiet);
  for (;;) {
    if (interrupts.take()) input.stop();
    session.attend();
    if (!loader.wait(kTick)) continue;
    const auto frame = loader.next();
    if (!frame) break;
    session.track(*frame);
    progress.update(session.status().frames());
  }
  progress.finish();
  for (const std::string& fault : input.source().faults()) progress.message("stdc-slam: " + fault);
}

void check_options(const Ros2Options& options, const Settings& settings) {
  RunOptions map_options;
  map_options.load_map = options.load_map;
  map_options.save_map = options.save_map;
  check_map_options(map_options, settings);
  check_place_for_map(map_options);
}

}  // namespace

bool run_ros2(const Ros2Options& options) {
  const InterruptWatch interrupts;
  cv::setNumThreads(1);  // as in `run`
  const Settings settings = ros2_settings(options);
  check_options(options, settings);
  ros2::Node node(ros2::options_from_environment());
  ros2::SlamPublisher publisher(node, options.names);
  ros2::Requests requests(node, options.names.prefix);
  auto owned = open_ros2_source(node, options.images, options.camera.has_value());
  ros2::Ros2Source& source = *owned;
  const auto publish = [&publisher](const ros2::DiagnosticStatus& status) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    publisher.publish_diagnostics(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count(),
                                  std::array{status});
  };
  if (!wait_for_cameras(node, source, interrupts, publish)) return true;
  InputOptions input_options;
  input_options.camera = options.camera;
  input_options.frames = options.frames;
  SequenceInput input(input_options, std::move(owned));
  input.name = options.images.colour;
  const auto make_segmenter = [&] {
    return chosen_segmenter(options.segmentation, settings, "", input.camera.rotation);
  };
  Ros2Session session({options, source, publisher, requests}, input.camera, settings, make_segmenter);
  std::optional<LiveView> view;
  if (options.view.port) {
    view.emplace(options.view, input, settings, true, options.quiet, interrupts);
    view->begin([&session]() -> const Slam& { return session.slam(); });
    session.add_observer(*view);
  }
  find_mount(options, session, interrupts);
  track_all(input, settings, options, interrupts, session);
  session.finish();
  return session.status().located() > 0;
}

}  // namespace stdc::app
