// compose_movers: pastes a mover into a recorded sequence, for cases that no recording at hand has. See
// docs/simulation.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <opencv2/core.hpp>

#include "core/image_codec.hpp"
#include "input/camera_file.hpp"
#include "input/layouts/tum_sequence.hpp"
#include "simulation/compose/mover_paster.hpp"
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

void write_bytes(const fs::path& path, const char* data, std::size_t size) {
  std::ofstream file(path, std::ios::binary);
  file.write(data, static_cast<std::streamsize>(size));
  file.close();
  if (!file)
    throw Error(path.string(), "cannot be written", "check the folder's permissions and the free space");
}

void write_png(const fs::path& path, const cv::Mat& image) {
  const std::vector<std::uint8_t> bytes = encode_png(image, PngEffort::fast);
  write_bytes(path, reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

/// Writes a composed sequence beside its place and moves it there when it is complete.
class Composer {
 public:
  Composer(const TumSequence& sequence, const Camera& camera, const fs::path& output)
      : sequence_(sequence), camera_(camera), output_(fs::absolute(output).lexically_normal()) {
    if (!output_.has_filename()) output_ = output_.parent_path();
    if (fs::exists(output_))
      throw Error(output_.string(), "is there already", "remove it or choose another folder");
    partial_ = output_.parent_path() / fmt::format(".{}.partial", output_.filename().string());
    fs::remove_all(partial_);
    for (const char* part : {"rgb", "depth", "mask"}) fs::create_directories(partial_ / part);
    names_.resize(sequence.frames().size());
  }
  ~Composer() {
    std::error_code ignored;
    fs::remove_all(partial_, ignored);
  }
  Composer(const Composer&) = delete;
  Composer& operator=(const Composer&) = delete;

  /// The frame with the mover in it. Returns the share of the view that it covers.
  double paste(int index, const simulation::Passage& passage, const simulation::MoverPaster& paster,
               std::uint64_t seed) {
    const SequenceFrame& frame = sequence_.frames()[index];
    RgbdImage recorded = load_frame(frame, camera_);
    if (recorded.colour.channels() != 3)
      throw Error(frame.colour.string(), "is grey", "movers are pasted into colour images only");
    const auto mover = passage.mover(index);
    const simulation::PastedFrame pasted =
        paster.paste(recorded, passage.room_from_cam(index), *mover, seed * 1000003ULL + index);
    const int count = cv::countNonZero(pasted.mask);
    if (count == 0) {
      keep(index);
      return 0;
    }
    const std::string name = frame.colour.stem().string() + ".png",
                      depth = frame.depth.stem().string() + ".png";
    write_png(partial_ / "rgb" / name, pasted.image.colour);
    write_png(partial_ / "depth" / depth, pasted.image.depth);
    write_png(partial_ / "mask" / name, pasted.mask);
    names_[index] = {"rgb/" + name, "depth/" + depth};
    return static_cast<double>(count) / static_cast<double>(pasted.mask.total());
  }

  /// The frame as it was recorded, byte by byte.
  void keep(int index) {
    const SequenceFrame& frame = sequence_.frames()[index];
    fs::copy_file(frame.colour, partial_ / "rgb" / frame.colour.filename());
    fs::copy_file(frame.depth, partial_ / "depth" / frame.depth.filename());
    write_png(partial_ / "mask" / (frame.colour.stem().string() + ".png"),
              cv::Mat::zeros(camera_.height, camera_.width, CV_8UC1));
    names_[index] = {"rgb/" + frame.colour.filename().string(), "depth/" + frame.depth.filename().string()};
  }

  void finish() {
    std::string colour = "# color images\n# timestamp filename\n",
                depth = "# depth maps\n# timestamp filename\n";
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const SequenceFrame& frame = sequence_.frames()[i];
      colour += fmt::format("{:.6f} {}\n", frame.timestamp, names_[i].first);
      depth += fmt::format("{:.6f} {}\n", frame.depth_timestamp, names_[i].second);
    }
    write_bytes(partial_ / "rgb.txt", colour.data(), colour.size());
    write_bytes(partial_ / "depth.txt", depth.data(), depth.size());
    const std::string yaml = "# Lengths in pixels.\n" + format_camera(camera_);
    write_bytes(partial_ / "camera.yaml", yaml.data(), yaml.size());
    if (sequence_.has_ground_truth())
      fs::copy_file(sequence_.folder() / "groundtruth.txt", partial_ / "groundtruth.txt");
    fs::rename(partial_, output_);
  }

 private:
  const TumSequence& sequence_;
  const Camera& camera_;
  fs::path output_, partial_;
  std::vector<std::pair<std::string, std::string>> names_;  ///< colour and depth, as in the lists
};

void compose(const Options& options) {
  const TumSequence sequence(options.sequence);
  const Camera camera =
      find_camera(sequence, options.camera.empty() ? std::nullopt : std::optional<fs::path>(options.camera));
  simulation::PassageSettings settings = options.passage;
  settings.mover = mover_named(options.mover);
  const double farthest = settings.mover == simulation::PastedMover::person ? 1.5 : 1.0;
  settings.distance = options.distance > 0 ? options.distance : free_distance(sequence, camera, farthest);
  Composer composer(sequence, camera, options.output);
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
      composer.keep(i);
    } else {
      shares[i] = composer.paste(i, passage, paster, settings.seed);
    }
  }
  composer.finish();
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
  CLI::App app{"Pastes a mover, with its depth and its mask, into a recorded sequence in TUM layout"};
  app.add_option("SEQUENCE", options.sequence, "Folder of the recording")->required();
  app.add_option("--output", options.output, "Folder to make")->required();
  app.add_option("--mover", options.mover, "board, box or person")->capture_default_str();
  app.add_option("--share", options.passage.share, "Of the view that the board covers, on average")
      ->check(CLI::Range(0.1, 0.95))
      ->capture_default_str();
  app.add_option("--frames", options.passage.frames, "For how long the board covers it, or the box passes")
      ->check(CLI::Range(10, 100000))
      ->capture_default_str();
  app.add_option("--start", options.passage.start,
                 "Frame in which the passage begins; default: in the middle")
      ->check(CLI::Range(0, 1000000));
  app.add_option("--distance", options.distance,
                 "From the camera, along its gaze [m]; default: 1, person 1.5, or less to be before what was "
                 "recorded")
      ->check(CLI::Range(0.2, 5.0));
  app.add_option("--seed", options.passage.seed, "Of textures and noise")->capture_default_str();
  app.add_option("--camera", options.camera, "camera.yaml; default: as stdc-slam run finds it");
  try {
    app.parse(argc, argv);
    compose(options);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
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
