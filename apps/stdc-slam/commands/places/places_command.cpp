// stdc-slam places: precision and recall of place recognition on a sequence with known poses.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "commands/commands.hpp"
#include "commands/options/input_options.hpp"
#include "commands/places/place_recognition_evaluation.hpp"
#include "core/error.hpp"
#include "core/images/image_codec.hpp"
#include "input/frame_decoder.hpp"
#include "report/pictures/svg_plot.hpp"
#include "report/quantiles.hpp"
#include "run/output_folder.hpp"
#include "run/progress.hpp"
#include "run/sequence_input.hpp"

namespace stdc::app {
namespace {

struct PlacesOptions {
  InputOptions input;
  std::optional<std::string> output;
  int step = 5;
  PlaceRecognitionTestSettings test;
  bool json = false, quiet = false;
};

/// The true pose at a time, if there is one within 20 ms.
std::optional<Pose> pose_at(const Trajectory& truth, double timestamp) {
  constexpr double kMaxDifference = 0.02;
  const auto later = std::lower_bound(truth.begin(), truth.end(), timestamp,
                                      [](const StampedPose& p, double t) { return p.timestamp < t; });
  const StampedPose* nearest = nullptr;
  const auto consider = [&](const StampedPose& p) {
    const double difference = std::abs(p.timestamp - timestamp);
    if (difference > kMaxDifference) return;
    if (nearest == nullptr || difference < std::abs(nearest->timestamp - timestamp)) nearest = &p;
  };
  if (later != truth.end()) consider(*later);
  if (later != truth.begin()) consider(*(later - 1));
  if (nearest == nullptr) return {};
  return nearest->world_from_cam.inverse();
}

/// What became of the views.
struct ViewCounts {
  int views = 0, without_pose = 0;
  double first_time = 0, last_time = 0;  ///< of all frames [s]
};

/// Adds every view that has a true pose.
ViewCounts run_test(const PlacesOptions& options, const SequenceInput& input, PlaceRecognitionTest& test) {
  const std::optional<int> frames = input.frame_count();
  Progress progress("recognising", "views",
                    frames ? std::optional((*frames + options.step - 1) / options.step) : std::nullopt,
                    options.quiet);
  const FrameDecoder decoder(input.cameras);
  FrameSource& source = input.start();
  ViewCounts counts;
  for (int i = 0; i < input.end_frame().value_or(std::numeric_limits<int>::max()); ++i) {
    const auto frame = source.next();
    if (!frame) break;
    if (i < input.first_frame() || (i - input.first_frame()) % options.step != 0) continue;
    if (counts.views++ == 0) counts.first_time = frame->timestamp;
    counts.last_time = frame->timestamp;
    const auto pose = pose_at(*input.truth(), frame->timestamp);
    if (!pose) {
      ++counts.without_pose;
    } else {
      test.add(i, decoder.decode(*frame, ColourMode::grey), *pose);
    }
    progress.update(counts.views);
  }
  return counts;
}

[[noreturn]] void refuse_truth(const SequenceInput& input, double first, double last) {
  const Trajectory& truth = input.required_truth();
  throw Error(
      input.truth_path().string(),
      fmt::format("has no pose within 20 ms of any image (poses: {:.3f} to {:.3f} s, images: {:.3f} to "
                  "{:.3f} s)",
                  truth.front().timestamp, truth.back().timestamp, first, last),
      "give the truth of the same recording, with times in seconds");
}

/// Throws Error if no image has a true pose, as far as that is known beforehand: then there is nothing to
/// judge.
void check_truth(const SequenceInput& input) {
  const Trajectory& truth = input.required_truth();
  const auto times = input.frame_times();
  if (!times || times->empty()) return;
  const bool any = std::any_of(times->begin(), times->end(),
                               [&](double time) { return pose_at(truth, time).has_value(); });
  if (!any) refuse_truth(input, times->front(), times->back());
}

std::optional<double> median(const std::vector<double>& values) { return quantiles(values).median; }

std::optional<double> share(int part, int whole) {
  return whole > 0 ? std::optional(static_cast<double>(part) / whole) : std::nullopt;
}

std::string format_scores(const PlaceScores& scores, const PlaceRecognitionTest& test,
                          const PlaceRecognitionTestSettings& settings) {
  const int verified = scores.verified_right + scores.verified_wrong;
  const auto if_verified = [&](double value) { return verified > 0 ? std::optional(value) : std::nullopt; };
  std::string text =
      fmt::format("{} views; {} see at least {:.0f} % of a view that is {:g} s older or more\n", scores.views,
                  scores.possible, 100 * settings.overlap, settings.gap);
  text += fmt::format("first answer right:      {:>6} %   among the first five {} %\n",
                      to_text(share(scores.first_right, scores.possible), 1, 100),
                      to_text(share(scores.five_right, scores.possible), 1, 100));
  text += fmt::format("average precision:       {:>6}     recall at 100 % precision {} % (score above {})\n",
                      to_text(scores.first.average_precision, 3),
                      to_text(scores.first.recall_without_error, 1, 100),
                      to_text(scores.first.best_wrong_score, 4));
  text += fmt::format("verified: precision      {:>6} %   recall {} %   ({} right, {} wrong)\n",
                      to_text(share(scores.verified_right, verified), 1, 100),
                      to_text(share(scores.verified_right, scores.possible), 1, 100), scores.verified_right,
                      scores.verified_wrong);
  text += fmt::format("their poses: max error   {:>6} mm  {} degrees\n",
                      to_text(if_verified(scores.worst_error_m), 1, 1e3),
                      to_text(if_verified(scores.worst_error_rad), 2, 57.29577951308232));
  text += fmt::format("CPU time, medians:       {:>6} ms a query, {} ms a verification\n",
                      to_text(median(test.query_ms()), 2), to_text(median(test.verify_ms()), 2));
  return text;
}

nlohmann::json to_json(const PlaceScores& scores, const PlaceRecognitionTest& test) {
  const bool verified = scores.verified_right + scores.verified_wrong > 0;
  const auto if_verified = [&](double value) {
    return app::to_json(verified ? std::optional(value) : std::nullopt);
  };
  return {{"views", scores.views},
          {"possible", scores.possible},
          {"first_right", scores.first_right},
          {"five_right", scores.five_right},
          {"average_precision", app::to_json(scores.first.average_precision)},
          {"recall_without_error", app::to_json(scores.first.recall_without_error)},
          {"best_wrong_score", app::to_json(scores.first.best_wrong_score)},
          {"verified_right", scores.verified_right},
          {"verified_wrong", scores.verified_wrong},
          {"worst_error_m", if_verified(scores.worst_error_m)},
          {"worst_error_rad", if_verified(scores.worst_error_rad)},
          {"query_ms", app::to_json(median(test.query_ms()))},
          {"verify_ms", app::to_json(median(test.verify_ms()))}};
}

/// Precision over recall, as SVG.
std::string draw_curve(const PlaceScores& scores, const std::string& name) {
  SvgPlot plot({70, 80, 560, 560}, {{-0.02, -0.02}, {1.02, 1.02}, "recall", "precision", true});
  std::vector<Eigen::Vector2d> curve{{0, 1}};
  for (const PrecisionRecallPoint& point : scores.first.curve)
    curve.emplace_back(point.recall, point.precision);
  constexpr const char* kByScore = "#0072b2";
  constexpr const char* kVerified = "#d55e00";
  plot.line(curve, 2, kByScore);
  plot.legend("by score alone", kByScore);
  const int verified = scores.verified_right + scores.verified_wrong;
  if (verified > 0 && scores.possible > 0) {
    plot.dots({{share(scores.verified_right, scores.possible).value_or(0),
                share(scores.verified_right, verified).value_or(0)}},
              5, kVerified);
    plot.legend("verified", kVerified, true);
  }
  return svg_drawing(680, 710,
                     fmt::format("Places recognised in {}: {} views, {} see a place again", name,
                                 scores.views, scores.possible),
                     {plot});
}

/// Empty where there was no answer, or no pose.
std::string format_answers(const std::vector<PlaceAnswer>& answers) {
  std::string text = "frame,best_overlap,found,score,overlap,overlap_of_five,verified,error_m,error_rad\n";
  for (const PlaceAnswer& a : answers) {
    text += fmt::format("{},{:.4f},", a.frame, a.best_overlap);
    text += a.found ? fmt::format("{},{:.6f},{:.4f},{:.4f},", *a.found, a.score, a.overlap, a.overlap_of_five)
                    : std::string(",,,,");
    text += a.verified ? fmt::format("1,{:.5f},{:.5f}\n", a.error_m, a.error_rad) : std::string("0,,\n");
  }
  return text;
}

void run(const PlacesOptions& options) {
  const SequenceInput input(options.input);
  check_truth(input);
  std::optional<OutputFolder> output;
  if (options.output) output.emplace(*options.output);
  PlaceRecognitionTest test(input.camera, options.test);
  const ViewCounts counts = run_test(options, input, test);
  if (counts.without_pose == counts.views) refuse_truth(input, counts.first_time, counts.last_time);
  if (counts.without_pose > 0) {
    fmt::print(stderr, "stdc-slam: {}: {} views have no pose within 20 ms and are left out\n",
               input.truth_path().string(), counts.without_pose);
  }
  const PlaceScores scores = score_places(test.answers(), options.test);
  if (output) {
    output->write("places.csv", format_answers(test.answers()));
    output->write("places.svg", draw_curve(scores, input.name));
    output->commit();
  }
  fmt::print("{}",
             options.json ? to_json(scores, test).dump(2) + "\n" : format_scores(scores, test, options.test));
}

}  // namespace

void add_places_command(Command program) {
  auto options = std::make_shared<PlacesOptions>();
  Command command =
      program.add_subcommand("places", "Precision and recall of place recognition against poses");
  command.add_option("INPUT", options->input.path, std::string(kInputHelp) + ", with true poses").required();
  add_frames_option(command, options->input);
  command.add_option("--step", options->step, "Every how many frames there is a view")
      .in_range(1, 10000)
      .capture_default_str();
  command.add_option("--gap", options->test.gap, "Seconds for which a place must have been left")
      .in_range(0.0, 1e6)
      .capture_default_str();
  command
      .add_option("--overlap", options->test.overlap,
                  "Share of the view that must have been seen before for there to be a place to find")
      .in_range(PlaceRecognitionTest::kRight, 1.0)
      .capture_default_str();
  add_input_options(command, options->input);
  add_truth_option(command, options->input);
  command.add_option("--output", options->output, "Folder for places.csv and places.svg (the curve)");
  command.add_flag("--json", options->json, "Print JSON");
  command.add_flag("--quiet", options->quiet, "No progress");
  command.footer(R"(
Each view asks for its place among the views before it. An answer is right if a tenth of the view's points, by
the true poses and the depths, is seen by it too. By score alone, and verified: matched, aligned, and refined as
a loop is; a verified pose is wrong if it is further off than 20 cm or 10 degrees.

Examples:
  stdc-slam places static-room
  stdc-slam places rgbd_dataset_freiburg1_room --step 10 --output results)");
  command.callback([options] { run(*options); });
}

}  // namespace stdc::app
