#include "run/run_ros2.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <opencv2/core/utility.hpp>
#include <thread>

#include "core/error.hpp"
#include "input/recordings/topic_names.hpp"
#include "run/frame_loader.hpp"
#include "run/interrupt_watch.hpp"
#include "run/live_view.hpp"
#include "run/progress.hpp"
#include "run/ros2_session.hpp"
#include "run/run_checks.hpp"
#include "run/sequence_input.hpp"
#include "run/track_frames.hpp"

namespace stdc::app {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kTick(50);

ros2::Reception reception_of(const std::string& name) {
  if (name == "best-effort") return ros2::Reception::best_effort;
  if (name == "reliable") return ros2::Reception::reliable;
  return ros2::Reception::every_frame;
}

ros2::Ros2SourceOptions source_options(const Ros2Options& options) {
  ros2::Ros2SourceOptions source;
  source.topics = options.topics;
  if (source.topics.colour_info.empty()) {
    source.topics.colour_info = camera_of_topic(options.topics.colour) + "/camera_info";
  }
  if (source.topics.depth_info.empty()) {
    source.topics.depth_info = camera_of_topic(options.topics.depth) + "/camera_info";
  }
  source.reception = reception_of(options.reception);
  source.max_difference = options.max_difference;
  source.camera_is_known = options.camera.has_value();
  return source;
}

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

/// Tells on the terminal, once, what keeps images from coming; and once a second whoever reads diagnostics.
class Waiting {
 public:
  Waiting(const ros2::Node& node, const ros2::Ros2Source& source, ros2::SlamPublisher& publisher)
      : node_(node), source_(source), publisher_(publisher) {}

  void attend() {
    constexpr std::chrono::seconds kInterval(1), kGrace(2);
    if (Clock::now() < next_report_) return;
    next_report_ = Clock::now() + kInterval;
    const std::array statuses{Ros2Status::camera_status(source_, 0)};
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    publisher_.publish_diagnostics(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count(),
                                   statuses);
    if (statuses[0].message == said_ || Clock::now() < start_ + kGrace) return;
    said_ = statuses[0].message;
    fmt::print(stderr, "stdc-slam: waiting: {}{}\n", said_, image_topics());
  }

 private:
  std::string image_topics() const {
    std::string names;
    for (const ros2::PublishedTopic& topic : node_.published()) {
      if (topic.type != "sensor_msgs/msg/Image") continue;
      names += (names.empty() ? "" : ", ") + topic.name;
    }
    return fmt::format("; there is {}", names.empty() ? "no topic with images" : names);
  }

  const ros2::Node& node_;
  const ros2::Ros2Source& source_;
  ros2::SlamPublisher& publisher_;
  Clock::time_point start_ = Clock::now(), next_report_ = start_;
  std::string said_;
};

/// @returns false if the program was interrupted
bool wait_for_cameras(ros2::Ros2Source& source, Waiting waiting, const InterruptWatch& interrupts) {
  while (!source.wait_for_cameras(kTick)) {
    if (interrupts.take()) return false;
    waiting.attend();
  }
  return true;
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
  auto owned = std::make_unique<ros2::Ros2Source>(node, source_options(options));
  ros2::Ros2Source& source = *owned;
  if (!wait_for_cameras(source, {node, source, publisher}, interrupts)) {
    fmt::print(stderr, "stdc-slam: interrupted before images came; there is nothing to write\n");
    return true;
  }
  InputOptions input_options;
  input_options.camera = options.camera;
  input_options.frames = options.frames;
  SequenceInput input(input_options, std::move(owned));
  input.name = options.topics.colour;
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
