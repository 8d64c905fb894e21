// compose_movers: pastes a mover into a recorded sequence, for cases that no recording at hand has. See
// docs/simulation.md.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "commands/command.hpp"
#include "composed_sequence.hpp"
#include "input/layouts/tum_sequence.hpp"
#include "simulation/compose/passage.hpp"
#include "simulation/sequence/camera_path.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string sequence, output, camera, mover = "board";
  double distance = 0;  ///< 0: by the mover and the recorded depth
  simulation::PassageSettings passage;
};

simulation::PastedMover mover_named(const std::string& name) {
  for (const auto& [mover, word] : EnumNames<simulation::PastedMover>::values) {
    if (name == word) return mover;
  }
  throw Error("--mover", "there is no mover \"" + name + "\"", "choose one of board, box, person");
}

/// The pose at a time between two of a trajectory; before its begin and after its end, the nearest.
Pose pose_at(const Trajectory& truth, double time) {
  const auto after = std::lower_bound(truth.begin(), truth.end(), time,
                                      [](const StampedPose& p, double t) { return p.timestamp < t; });
  if (after == truth.begin()) return truth.front().world_from_cam;
  if (after == truth.end()) return truth.back().world_from_cam;
  const StampedPose &a = *(after - 1), &b = *after;
  const double f = (time - a.timestamp) / (b.timestamp - a.timestamp);
  return {a.world_from_cam.rotation.slerp(f, b.world_from_cam.rotation),
          a.world_from_cam.translation + f * (b.world_from_cam.translation - a.world_from_cam.translation)};
}

/// The cameras by the ground truth. Without one the camera stands still, and the mover passes before it.
simulation::RecordedPath recorded_path(const TumSequence& sequence) {
  simulation::RecordedPath path;
  Trajectory truth;
  if (sequence.has_ground_truth()) truth = sequence.ground_truth().poses;
  for (const SequenceFrame& frame : sequence.frames()) {
    path.times.push_back(frame.timestamp);
    path.world_from_cam.push_back(truth.empty() ? simulation::look_at({0, -2.55, 1.45}, {0, 0.9, 0.8})
                                                : pose_at(truth, frame.timestamp));
  }
  return path;
}

/// The distance at which a mover hides nearly all that was recorded, at most `farthest` [m].
double free_distance(const TumSequence& sequence, const Camera& camera, double farthest) {
  constexpr int kLooks = 12;
  constexpr double kNearest = 0.6;  // the sensor sees nothing before 0.5 m
  std::vector<std::uint16_t> depths;
  const std::size_t count = sequence.frames().size();
  for (std::size_t i = 0; i < count; i += std::max<std::size_t>(1, count / kLooks)) {
    const cv::Mat depth = load_frame(sequence.frames()[i], camera).depth;
    for (int y = 0; y < depth.rows; y += 4) {
      for (int x = 0; x < depth.cols; x += 4) {
        if (depth.at<std::uint16_t>(y, x) > 0) depths.push_back(depth.at<std::uint16_t>(y, x));
      }
    }
  }
  if (depths.empty()) return farthest;
  const auto tenth = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 10);
  std::nth_element(depths.begin(), tenth, depths.end());
  return std::clamp(0.95 * *tenth / camera.depth_units_per_metre, kNearest, farthest);
}

void compose(const Options& options) {
  const TumSequence sequence(options.sequence);
  const Camera camera =
      find_camera(sequence, options.camera.empty() ? std::nullopt : std::optional<fs::path>(options.camera));
  simulation::PassageSettings settings = options.passage;
  settings.mover = mover_named(options.mover);
  const double farthest = settings.mover == simulation::PastedMover::person ? 1.5 : 1.0;
  settings.distance = options.distance > 0 ? options.distance : free_distance(sequence, camera, farthest);
  ComposedSequence composed(sequence, camera, options.output);
  const simulation::Room room = simulation::make_room(settings.seed, false);
  const simulation::RayScene scene(room.world.mesh, simulation::TreeQuality::good);
  const simulation::BakedLight light(room.world, scene);
  const simulation::SurfaceShader shader(room.world, light);
  const simulation::Passage passage(settings, recorded_path(sequence), camera, room, light);
  const simulation::MoverPaster paster(camera, shader);
  const auto count = static_cast<int>(sequence.frames().size());
  std::vector<double> shares(sequence.frames().size(), 0);
  for (int i = 0; i < count; ++i) {
    if (i < passage.first() || i >= passage.last()) {
      composed.keep(i);
    } else {
      shares[i] = composed.paste(i, passage, paster, settings.seed);
    }
  }
  composed.finish();
  // The mean is that of the middle of the passage: at its ends the mover comes in and goes.
  const int middle = std::min(settings.frames, passage.last() - passage.first());
  const auto from = shares.begin() + (passage.first() + passage.last() - middle) / 2;
  fmt::print("{}: {} at {:.2f} m, frames {} to {} of {}, covers {:.0f} % on average and {:.0f} % at most\n",
             options.output, options.mover, settings.distance, passage.first(), passage.last() - 1, count,
             100 * std::accumulate(from, from + middle, 0.0) / middle,
             100 * *std::max_element(shares.begin(), shares.end()));
}

int run(int argc, char** argv) {
  constexpr int kBadInput = 2;
  Options options;
  auto program = app::Program::tool(
      "compose_movers",
      "Pastes a mover, with its depth and its mask, into a recorded sequence in TUM layout");
  app::Command command = program.root();
  command.add_option("SEQUENCE", options.sequence, "Folder of the recording").required();
  command.add_option("--output", options.output, "Folder to make").required();
  command.add_option("--mover", options.mover, "board, box or person").capture_default_str();
  command.add_option("--share", options.passage.share, "Of the view that the board covers, on average")
      .in_range(0.1, 0.95)
      .capture_default_str();
  command
      .add_option("--frames", options.passage.frames, "For how long the board covers it, or the box passes")
      .in_range(10, 100000)
      .capture_default_str();
  command
      .add_option("--start", options.passage.start,
                  "Frame in which the passage begins; default: in the middle")
      .in_range(0, 1000000);
  command
      .add_option(
          "--distance", options.distance,
          "From the camera, along its gaze [m]; default: 1, person 1.5, or less to be before what was "
          "recorded")
      .in_range(0.2, 5.0);
  command.add_option("--seed", options.passage.seed, "Of textures and noise").capture_default_str();
  command.add_option("--camera", options.camera, "camera.yaml; default: as stdc-slam run finds it");
  command.callback([&] { compose(options); });
  try {
    return program.run(argc, argv);
  } catch (const Error& error) {
    std::fprintf(stderr, "compose_movers: %s\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "compose_movers: %s\n", error.what());
    return 1;
  }
}

}  // namespace
}  // namespace stdc

int main(int argc, char** argv) { return stdc::run(argc, argv); }
