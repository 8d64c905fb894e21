// stdc-slam render: makes a sequence with exact poses and masks.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "commands/commands.hpp"
#include "core/error.hpp"
#include "input/camera_file.hpp"
#include "run/interrupt_watch.hpp"
#include "run/progress.hpp"
#include "simulation/sequence/rendered_sequence.hpp"
#include "simulation/sequence/sequence_writer.hpp"

namespace stdc::app {
namespace {

struct RenderOptions {
  std::string preset, output, camera;
  int frames = 0;  ///< 0: as many as the preset has
  int threads = 0;
  std::uint64_t seed = 1;
  bool without_people = false, motion_blur = false, overwrite = false, quiet = false;
};

/// Frames are rendered by several threads, each taking the next one; what a frame looks like does not depend
/// on it.
class RenderJob {
 public:
  RenderJob(const simulation::RenderedSequence& sequence, simulation::SequenceWriter& writer, int frames)
      : sequence_(sequence), writer_(writer), frames_(frames) {}

  void run(int threads, const InterruptWatch& interrupts, Progress& progress) {
    std::vector<std::thread> workers;
    for (int i = 0; i < std::min(threads, frames_); ++i) workers.emplace_back([this] { work(); });
    while (done_ < frames_ && !stop_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      progress.update(done_);
      if (interrupts.interrupted()) stop_ = true;
    }
    for (std::thread& worker : workers) worker.join();
    if (failure_) std::rethrow_exception(failure_);
    if (done_ < frames_) {
      throw Error("interrupted",
                  fmt::format("stopped after {} of {} frames, nothing was written", done_.load(), frames_),
                  "start again, perhaps with fewer --frames");
    }
  }

 private:
  void work() {
    try {
      for (int i = next_++; i < frames_ && !stop_; i = next_++) {
        writer_.write(i, sequence_.render(i));
        ++done_;
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      stop_ = true;
    }
  }

  const simulation::RenderedSequence& sequence_;
  simulation::SequenceWriter& writer_;
  const int frames_;
  std::atomic<int> next_ = 0, done_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

/// What the renderer would pass over.
void check_effect(const RenderOptions& options, simulation::Preset preset,
                  const std::optional<Camera>& camera) {
  const bool still = preset == simulation::Preset::static_desk || preset == simulation::Preset::static_room;
  if (options.without_people && still) {
    throw Error("--without-people", fmt::format("has no effect, nothing moves in {}", options.preset),
                "leave it out");
  }
  if (!camera) return;
  if (camera->rotation != 0) {
    throw Error(options.camera,
                fmt::format("rotation {} cannot be rendered, the camera is held upright", camera->rotation),
                "leave it out of the camera file, or make it 0");
  }
}

void render(const RenderOptions& options) {
  const InterruptWatch interrupts;
  const simulation::Preset preset = simulation::preset_named(options.preset);
  simulation::RenderSettings settings;
  settings.seed = options.seed;
  settings.with_people = !options.without_people;
  settings.motion_blur = options.motion_blur;
  if (!options.camera.empty()) settings.camera = read_camera(options.camera);
  check_effect(options, preset, settings.camera);
  // The writer comes first: a bad output folder is found before any work is done.
  const int default_frames = simulation::RenderedSequence::frame_count(
      preset, settings.camera.value_or(simulation::default_render_camera()));
  const int frames = options.frames > 0 ? options.frames : default_frames;
  simulation::SequenceWriter writer(options.output,
                                    settings.camera.value_or(simulation::default_render_camera()), frames,
                                    options.overwrite);
  const simulation::RenderedSequence sequence(preset, settings);
  const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  {
    Progress progress("rendering", "frames", frames, options.quiet);
    RenderJob(sequence, writer, frames)
        .run(options.threads > 0 ? options.threads : cores, interrupts, progress);
  }
  writer.finish();
  if (!options.quiet) fmt::print("{} frames of {} are in {}\n", frames, options.preset, options.output);
}

std::string preset_list() {
  std::string list;
  for (const auto& [preset, name] : EnumNames<simulation::Preset>::values)
    list += fmt::format("{}{}", list.empty() ? "" : ", ", name);
  return list;
}

}  // namespace

void add_render_command(Command program) {
  auto options = std::make_shared<RenderOptions>();
  Command command =
      program.add_subcommand("render", "Render a sequence with exact poses and masks of what moves");
  command.add_option("PRESET", options->preset, "One of " + preset_list()).required();
  command.add_option("--output", options->output, "Folder to make").required();
  command.add_option("--frames", options->frames, "Only the first N frames, or more than the preset has")
      .in_range(1, 1000000);
  command.add_option("--seed", options->seed, "Of textures, clutter, people and noise; same seed, same bytes")
      .capture_default_str();
  command.add_flag("--without-people,--static", options->without_people,
                   "Same room and camera motion, without people and without anything that moves");
  command.add_flag("--motion-blur", options->motion_blur, "Expose for 1/60 s (6 times slower)");
  command.add_option("--camera", options->camera, "camera.yaml to render with, lens distortion included");
  command.add_option("--threads", options->threads, "How many; default: one for each core").in_range(1, 256);
  command.add_flag("--overwrite", options->overwrite, "Replace a sequence that is already there");
  command.add_flag("--quiet", options->quiet, "No progress");
  command.footer(R"(
The folder gets the layout of the TUM RGB-D benchmark: rgb/, depth/ (16 bit, 5000 per metre, 0 = missing),
rgb.txt, depth.txt, groundtruth.txt, camera.yaml, and mask/ (255 = people, and things while they move).
Presets in which things move also get moved/ (255 = people, and things that move at some time).

Examples:
  stdc-slam render static-room --output /tmp/room
  stdc-slam render walking-xyz --output /tmp/walking --frames 300 --seed 7
  stdc-slam render walking-xyz --output /tmp/alone --frames 300 --seed 7 --without-people
  stdc-slam render box-removed --output /tmp/clean --static)");
  command.callback([options] { render(*options); });
}

}  // namespace stdc::app
