// stdc-slam segment: masks of people and other dynamic classes, for images or a sequence.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "commands/options/input_options.hpp"
#include "commands/options/segmentation_options.hpp"
#include "commands/segment/image_segmentation.hpp"
#include "commands/segment/segment_images.hpp"
#include "commands/segment/truth_masks.hpp"
#include "core/error.hpp"
#include "core/images/image_codec.hpp"
#include "input/camera_file.hpp"
#include "report/segment_report.hpp"
#include "run/interrupt_watch.hpp"
#include "run/output_folder.hpp"
#include "run/progress.hpp"
#include "segmentation/network/network_segmenter.hpp"
#include "segmentation/network/weights_segmenter.hpp"

namespace stdc::app {
namespace {

struct SegmentOptions {
  InputOptions input;
  std::string output, size, truth_kind = "masks";
  std::optional<std::string> weights, truth;
  std::vector<std::string> dynamic_classes;
  int threads = 1;
  bool int8 = false, fp32 = false, no_overlays = false, quiet = false;
  SegmentationRequest wanted;
};

/// "512x384" as a size.
cv::Size parse_size(const std::string& text) {
  const auto number = [](std::string_view word) {
    int value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    return fault == std::errc() && end == word.data() + word.size() ? value : 0;
  };
  const std::size_t cross = text.find('x');
  const std::string_view view = text;
  const cv::Size size(number(view.substr(0, cross)),
                      cross == std::string::npos ? 0 : number(view.substr(cross + 1)));
  if (size.width > 0 && size.height > 0) return size;
  throw Error("--size", fmt::format("'{}' is not of the form WxH", text), "give for instance 512x384");
}

NetworkSettings network_settings(const SegmentOptions& options) {
  NetworkSettings settings;
  settings.threads = options.threads;
  if (options.int8) settings.precision = NetworkPrecision::int8;
  if (options.fp32) settings.precision = NetworkPrecision::fp32;
  if (!options.size.empty()) {
    const cv::Size size = parse_size(options.size);
    settings.input_width = size.width, settings.input_height = size.height;
  }
  check_ranges("network", settings);
  return settings;
}

/// An ONNX model is computed by OpenCV, which knows none of these.
void check_onnx_options(const SegmentOptions& options) {
  if (!options.weights || std::filesystem::path(*options.weights).extension() != ".onnx") return;
  const auto refuse = [](bool given, const char* option) {
    if (given)
      throw Error(option, "has no effect on an ONNX model", "leave it out, or give .safetensors weights");
  };
  refuse(options.int8, "--int8");
  refuse(options.fp32, "--fp32");
  refuse(options.threads != 1, "--threads");
  refuse(options.wanted.classes, "--classes");
  refuse(options.wanted.probability, "--probabilities");
}

TruthKind truth_kind(const SegmentOptions& options) {
  if (options.truth_kind == "masks") return TruthKind::masks;
  if (options.truth_kind == "labels") return TruthKind::labels;
  throw Error("--truth", fmt::format("'{}' is not known", options.truth_kind), "give masks or labels");
}

/// The camera whose `rotation` counts: --camera, or that of a sequence; nothing for photos.
std::optional<Camera> camera_of(const SegmentOptions& options, const SegmentImages& images) {
  if (options.input.camera) return read_cameras(*options.input.camera).colour;
  if (!images.is_sequence()) return std::nullopt;
  return images.camera().value_or(Camera());
}

/// Throws Error if no image could be scored; says on stderr if some could not.
void check_scores(const SegmentOptions& options, const std::vector<SegmentedImage>& results) {
  if (!options.truth) return;
  const auto not_scored = [](const SegmentedImage& result) { return !result.counts.has_value(); };
  const auto missing = static_cast<std::size_t>(std::count_if(results.begin(), results.end(), not_scored));
  if (missing == 0) return;
  if (missing == results.size()) {
    throw Error(*options.truth, "has no mask for any of the images",
                "give a folder of PNGs named like the images");
  }
  const auto first = std::find_if(results.begin(), results.end(), not_scored);
  fmt::print(stderr, "stdc-slam: {}: has no mask for {} of {} images, such as {}; they are not scored\n",
             *options.truth, missing, results.size(), first->name);
}

void segment(const SegmentOptions& options) {
  const InterruptWatch interrupts;
  cv::setNumThreads(1);  // as in `run`
  SegmentImages images(options.input);
  std::optional<TruthMasks> truths;
  if (options.truth) truths.emplace(*options.truth, truth_kind(options));
  check_onnx_options(options);
  const std::optional<Camera> camera = camera_of(options, images);
  const auto segmenter = make_weights_segmenter(options.weights.value_or(""), network_settings(options),
                                                options.dynamic_classes);
  OutputFolder output(options.output);
  ImageSegmentation segmentation(*segmenter, options.wanted, camera, options.input.camera.has_value(),
                                 !options.no_overlays, output);
  std::vector<SegmentedImage> results;
  std::string masks;  // which mask belongs to which time, as `run --masks` reads it
  Progress progress("segmenting", "images", images.count(), options.quiet);
  while (const auto image = images.next()) {
    if (interrupts.interrupted()) {
      const auto count = images.count();
      throw Error("interrupted",
                  fmt::format("stopped after {}{} images, nothing was written", results.size(),
                              count ? fmt::format(" of {}", *count) : ""),
                  "start again, perhaps with fewer --frames");
    }
    const auto number = static_cast<int>(results.size());
    results.push_back(segmentation.segment(*image, number, truths));
    if (image->timestamp) masks += fmt::format("{:.6f} {}.png\n", *image->timestamp, image->name);
    progress.update(static_cast<int>(results.size()));
  }
  progress.finish();
  if (results.empty()) throw Error(options.input.path.string(), "holds no image", "give another input");
  check_scores(options, results);
  output.write("segments.csv", segments_csv(results, segmentation.shared_classes()));
  if (!masks.empty()) output.write("mask.txt", masks);
  output.commit();
  if (options.quiet) return;
  if (const auto* network = dynamic_cast<const NetworkSegmenter*>(segmenter.get())) {
    fmt::print("network     {}\n", network->description());
  }
  fmt::print("{}results: {}\n", segment_summary(results, segmentation.shared_classes()), options.output);
}

constexpr const char* kSegmentFooter = R"(
INPUT is an image, a folder of images (PNG, JPEG), or a recording of any kind that `run` takes. Written to the output
folder, all at the end or nothing:
  NAME.png          mask of the image NAME.*: 255 = dynamic, else 0; `run --masks` takes the folder as it is
  NAME-overlay.jpg  the image with the mask drawn over it, each dynamic class in a colour of its own
  NAME-classes.png  with --classes: the number of each pixel's class, in the order of the weights file
  NAME-probability.png  with --probabilities: how likely each pixel is dynamic, 0 to 65535 (16 bits); calibrated
                    if the weights say how
  mask.txt          of a sequence: the time of each mask
  segments.csv      share of dynamic pixels, milliseconds and scores of every image; the share of each class
                    if several are dynamic

Photos are segmented upright, as their EXIF orientation says (JPEG, and eXIf of PNG). NAME.png lies on the
pixels as they are stored in the file, NAME-overlay.jpg is upright, as viewers show the photo; true masks may have
either size. A camera mounted on its side: 'rotation: 90' in the camera file of --camera or of the sequence, degrees
clockwise that turn the image upright; then EXIF is not applied, and all results lie as the images do.

Scores: IoU, precision and recall of the dynamic pixels; boundary F: how well the outlines agree (within 0.8 %
of the diagonal). The mean is over images where a score is defined; 'all pixels' counts all images as one.

Examples:
  stdc-slam segment photo.jpg --output masks
  stdc-slam segment rgbd_dataset_freiburg3_walking_xyz --output masks --frames 0:300 --int8
  stdc-slam segment my-walk --output masks --score my-walk/mask
  stdc-slam segment frames --output masks --camera on-its-side.yaml
  stdc-slam segment photos --output masks --weights many.safetensors --dynamic person,animal --classes
  stdc-slam segment people/image --output masks --score people/label --truth labels --weights my.safetensors)";

}  // namespace

void add_segment_command(Command program) {
  auto options = std::make_shared<SegmentOptions>();
  Command command = program.add_subcommand("segment", "Find people and other dynamic things in images");
  command.add_option("INPUT", options->input.path, "Image, folder of images, or recording of any kind")
      .required();
  command.add_option("--output,-o", options->output, "Folder for the results; made if need be").required();
  command.add_option("--weights", options->weights,
                     "Weights of the network (.safetensors), an ONNX model, or which of the weights that "
                     "ship: slim, wide, or permissive; default: slim");
  const CommandOption int8 = command.add_flag(
      "--int8", options->int8, "Compute in 8 bits (default if the weights are calibrated for it)");
  command.add_flag("--fp32", options->fp32, "Compute in 32-bit floating point").excludes(int8);
  command.add_option("--frames", options->input.frames, "Only images A to B-1, counted from 0")
      .type_name("A:B");
  command
      .add_option("--size", options->size,
                  "Size of the network's input, multiples of 32; default: as the weights say")
      .type_name("WxH");
  add_input_options(command, options->input);
  command.add_option("--threads", options->threads, "Threads of inference").capture_default_str();
  const CommandOption score =
      command.add_option("--score", options->truth, "Folder of true masks to compare with")
          .type_name("FOLDER");
  command
      .add_option("--truth", options->truth_kind,
                  "What the true masks hold: masks (128 and above = dynamic) or labels (255 = in doubt)")
      .type_name("masks|labels")
      .capture_default_str()
      .needs(score);
  add_dynamic_option(command, options->dynamic_classes);
  command.add_flag("--classes", options->wanted.classes, "Write the class of each pixel, too");
  command.add_flag("--probabilities", options->wanted.probability,
                   "Write how likely each pixel is dynamic, too");
  command.add_flag("--no-overlays", options->no_overlays, "Write masks only");
  command.add_flag("--quiet,-q", options->quiet, "Print only what goes wrong");
  command.footer(kSegmentFooter);
  command.callback([options] { segment(*options); });
}

}  // namespace stdc::app
