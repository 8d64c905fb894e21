// stdc-slam features: quality and uniformity of the keypoints by both selections (Table 2 of the paper).
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "commands/options/input_options.hpp"
#include "core/error.hpp"
#include "core/images/image_codec.hpp"
#include "features/detection/uniformity.hpp"
#include "features/extractor.hpp"
#include "input/frame_decoder.hpp"
#include "report/pictures/debug_images.hpp"
#include "run/output_folder.hpp"
#include "run/progress.hpp"

namespace stdc::app {
namespace {

struct FeaturesOptions {
  InputOptions input;
  std::optional<std::string> debug_images;
  std::vector<int> frames;
  int keypoints = 218;
  bool markdown = false, json = false, quiet = false;
};

constexpr std::array kSelections{Selection::orb_slam3, Selection::improved};

/// Numbers of keypoints of a frame, or their means over several.
struct Distribution {
  double high = 0, low = 0, uniformity = 0;
};

struct Row {
  int frame = 0;
  std::array<Distribution, kSelections.size()> selections;
};

Distribution measure(const Features& features, cv::Size size) {
  const auto high = std::count_if(features.keypoints.begin(), features.keypoints.end(),
                                  [](const Keypoint& k) { return k.quality == KeypointQuality::high; });
  return {static_cast<double>(high),
          static_cast<double>(features.keypoints.size()) - static_cast<double>(high),
          uniformity(features.keypoints, size)};
}

Row average(const std::vector<Row>& rows) {
  Row sum;
  const auto count = static_cast<double>(rows.size());
  for (const Row& row : rows) {
    for (std::size_t s = 0; s < kSelections.size(); ++s) {
      sum.selections[s].high += row.selections[s].high / count;
      sum.selections[s].low += row.selections[s].low / count;
      sum.selections[s].uniformity += row.selections[s].uniformity / count;
    }
  }
  return sum;
}

[[noreturn]] void refuse_frame(int frame, int count) {
  throw Error("--frames", fmt::format("there is no frame {}", frame),
              fmt::format("give numbers from 0 to {}, separated by commas", count - 1));
}

/// Throws Error for frames that there are not, as far as that is known beforehand.
void check_frames(const FeaturesOptions& options, const SequenceInput& input) {
  const std::optional<int> count = input.frame_count();
  for (const int frame : options.frames) {
    if (frame < 0 || (count && frame >= *count)) refuse_frame(frame, count.value_or(1000000));
  }
}

std::vector<FeatureExtractor> make_extractors(const FeaturesOptions& options) {
  std::vector<FeatureExtractor> extractors;
  extractors.reserve(kSelections.size());
  for (const Selection selection : kSelections) {
    const FeatureSettings settings{.selection = selection, .keypoints = options.keypoints};
    try {
      settings.validate();
    } catch (const Error& error) {
      throw Error("--keypoints", error.problem(), error.hint());
    }
    extractors.emplace_back(settings);
  }
  return extractors;
}

/// The rows in the order in which the frames were asked for.
std::vector<Row> in_order(const std::vector<int>& frames, const std::map<int, Row>& rows, int count) {
  std::vector<Row> ordered;
  for (const int frame : frames) {
    const auto row = rows.find(frame);
    if (row == rows.end()) refuse_frame(frame, count);
    ordered.push_back(row->second);
  }
  if (frames.empty()) {
    for (const auto& [frame, row] : rows) ordered.push_back(row);
  }
  return ordered;
}

std::vector<Row> measure_frames(const FeaturesOptions& options) {
  const SequenceInput input(options.input);
  check_frames(options, input);
  std::vector<FeatureExtractor> extractors = make_extractors(options);
  std::optional<OutputFolder> pictures;
  if (options.debug_images) pictures.emplace(*options.debug_images);
  const std::set<int> wanted(options.frames.begin(), options.frames.end());
  Progress progress("extracting", "frames",
                    wanted.empty() ? input.frame_count() : std::optional(static_cast<int>(wanted.size())),
                    options.quiet);
  const FrameDecoder decoder(input.cameras);
  FrameSource& source = input.start();
  std::map<int, Row> rows;
  int number = 0;
  for (; wanted.empty() || rows.size() < wanted.size(); ++number) {
    const auto frame = source.next();
    if (!frame) break;
    if (!wanted.empty() && !wanted.contains(number)) continue;
    const cv::Mat grey = decoder.colour(*frame, ColourMode::grey);
    Row& row = rows[number] = Row{number, {}};
    for (std::size_t s = 0; s < kSelections.size(); ++s) {
      row.selections[s] = measure(extractors[s].extract(grey), grey.size());
      if (!pictures) continue;
      pictures->write(fmt::format("features-{:05}-{}.png", number, enum_name(kSelections[s])),
                      encode_png(draw_cells(grey, cv::Mat(), number, extractors[s].settings())));
    }
    progress.update(static_cast<int>(rows.size()));
  }
  progress.finish();
  std::vector<Row> ordered = in_order(options.frames, rows, number);
  if (pictures) pictures->commit();
  return ordered;
}

std::string format_row(const std::string& name, const Row& row, bool markdown) {
  std::string line = markdown ? "| " + name + " " : fmt::format("{:>9}", name);
  for (const Distribution& d : row.selections) {
    const double total = d.high + d.low;
    line += markdown ? fmt::format("| {:.0f} | {:.0f} | {:.0f} | {:.0f} ", d.high, d.low, total, d.uniformity)
                     : fmt::format("   {:>6.0f}{:>6.0f}{:>6.0f}{:>6.0f}", d.high, d.low, total, d.uniformity);
  }
  return line + (markdown ? "|\n" : "\n");
}

std::string format_table(const std::vector<Row>& rows, bool with_frames, bool markdown) {
  std::string text;
  if (markdown) {
    text = "| Frame ";
    for (const Selection s : kSelections)
      text += fmt::format("| {0} H | {0} L | {0} T | {0} U ", enum_name(s));
    text += "|\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  } else {
    text = fmt::format("{:>9}", "");
    for (const Selection s : kSelections) text += fmt::format("   {:^24}", enum_name(s));
    text += fmt::format("\n{:>9}", "frame");
    for (std::size_t s = 0; s < kSelections.size(); ++s)
      text += fmt::format("   {:>6}{:>6}{:>6}{:>6}", "H", "L", "T", "U");
    text += '\n';
  }
  if (with_frames) {
    for (const Row& row : rows) text += format_row(std::to_string(row.frame), row, markdown);
  }
  text += format_row(with_frames ? "average" : fmt::format("all {}", rows.size()), average(rows), markdown);
  if (!markdown) {
    text +=
        "H, L, T: keypoints of high and of low quality, and all. U: uniformity, the smaller the more even.\n";
  }
  return text;
}

nlohmann::json to_json(const Row& row) {
  nlohmann::json json;
  for (std::size_t s = 0; s < kSelections.size(); ++s) {
    const Distribution& d = row.selections[s];
    json[std::string(enum_name(kSelections[s]))] = {
        {"high", d.high}, {"low", d.low}, {"total", d.high + d.low}, {"uniformity", d.uniformity}};
  }
  return json;
}

std::string format_json(const FeaturesOptions& options, const std::vector<Row>& rows) {
  nlohmann::json json{{"sequence", options.input.path.string()},
                      {"keypoints", options.keypoints},
                      {"average", to_json(average(rows))}};
  for (const Row& row : rows) {
    json["frames"].push_back(to_json(row));
    json["frames"].back()["frame"] = row.frame;
  }
  return json.dump(2) + "\n";
}

void run(const FeaturesOptions& options) {
  const std::vector<Row> rows = measure_frames(options);
  fmt::print("{}", options.json ? format_json(options, rows)
                                : format_table(rows, !options.frames.empty(), options.markdown));
}

}  // namespace

void add_features_command(Command program) {
  auto options = std::make_shared<FeaturesOptions>();
  Command command =
      program.add_subcommand("features", "Compare the keypoint selections: quality and uniformity");
  command.add_option("INPUT", options->input.path, kInputHelp).required();
  command
      .add_option("--frames", options->frames, "Frames to show, counted from 0, e.g. 1,60,303 (default: all)")
      .delimiter(',')
      .one_value_each();
  command.add_option("--keypoints", options->keypoints, "Keypoints per image; the paper's Table 2 has 218")
      .capture_default_str();
  add_input_options(command, options->input);
  command.add_option("--debug-images", options->debug_images,
                     "Folder for pictures of the keypoints and quadtree cells of each frame");
  const CommandOption markdown = command.add_flag("--markdown", options->markdown, "Print a Markdown table");
  command.add_flag("--json", options->json, "Print JSON").excludes(markdown);
  command.add_flag("--quiet", options->quiet, "No progress");
  command.footer(R"(
Table 2 of the paper for any sequence: for each selection the numbers of keypoints of high (H) and low (L)
quality, all of them (T), and the uniformity of their distribution (U = 101 log10 of the variance of the counts
in ten regions; larger is less even).

Examples:
  stdc-slam features rgbd_dataset_freiburg1_desk --frames 1,60,303,482,512
  stdc-slam features my-room --keypoints 1000 --json > features.json
  stdc-slam features my-room --frames 20 --debug-images pictures)");
  command.callback([options] { run(*options); });
}

}  // namespace stdc::app
