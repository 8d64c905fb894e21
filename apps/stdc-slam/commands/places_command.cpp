// stdc-slam places: precision and recall of place recognition on a sequence with known poses.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "commands/commands.hpp"
#include "commands/place_recognition_evaluation.hpp"
#include "core/error.hpp"
#include "core/image_codec.hpp"
#include "report/plot.hpp"
#include "report/quantiles.hpp"
#include "run/output_folder.hpp"
#include "run/progress.hpp"
#include "run/sequence_input.hpp"

namespace stdc::app {
namespace {

struct Options {
  std::string sequence, frames;
  std::optional<std::string> camera, output;
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

/// Adds every view that has a true pose; @returns how many have none.
int run_test(const Options& options, const SequenceInput& input, PlaceRecognitionTest& test) {
  int without_pose = 0;
  const auto step = static_cast<std::size_t>(options.step);
  const std::size_t views = (input.frames.size() + step - 1) / step;
  Progress progress("recognising", "views", static_cast<int>(views), options.quiet);
  for (std::size_t i = 0; i < input.frames.size(); i += step) {
    const SequenceFrame& files = input.frames[i];
    const auto pose = pose_at(*input.truth, files.timestamp);
    if (!pose) {
      ++without_pose;
    } else {
      test.add(input.first_frame + static_cast<int>(i), load_frame(files, input.camera, ColourMode::grey),
               *pose);
    }
    progress.update(static_cast<int>(i / step) + 1);
  }
  return without_pose;
}

/// Throws Error if no image has a true pose: then there is nothing to judge.
void check_truth(const SequenceInput& input) {
  const Trajectory& truth = input.required_truth();
  const bool any = std::any_of(input.frames.begin(), input.frames.end(), [&](const SequenceFrame& frame) {
    return pose_at(truth, frame.timestamp).has_value();
  });
  if (any) return;
  throw Error(
      input.truth_path().string(),
      fmt::format("has no pose within 20 ms of any image (poses: {:.3f} to {:.3f} s, images: {:.3f} to "
                  "{:.3f} s)",
                  truth.front().timestamp, truth.back().timestamp, input.frames.front().timestamp,
                  input.frames.back().timestamp),
      "give the truth of the same recording, with times in seconds");
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

cv::Mat draw_curve(const PlaceScores& scores, const std::string& name) {
  const cv::Scalar blue(180, 100, 30), red(40, 40, 200);
  Plot plot({-0.02, -0.02}, {1.02, 1.02}, "Places recognised in " + name, "recall", "precision");
  Eigen::Vector2d before(0, 1);
  for (const PrecisionRecallPoint& point : scores.first.curve) {
    const Eigen::Vector2d here(point.recall, point.precision);
    plot.line(before, here, 2.5, blue);
    before = here;
  }
  const int verified = scores.verified_right + scores.verified_wrong;
  if (verified > 0 && scores.possible > 0) {
    plot.dot({share(scores.verified_right, scores.possible).value_or(0),
              share(scores.verified_right, verified).value_or(0)},
             7, red);
  }
  plot.finish_area();
  plot.legend_line("by score alone", 2.5, blue);
  if (verified > 0) plot.legend_dot("verified", 7, red);
  plot.legend_text(fmt::format("{} views", scores.views));
  plot.legend_text(fmt::format("{} see a place again", scores.possible));
  return plot.image();
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

void run(const Options& options) {
  const SequenceInput input(options.sequence, options.camera, options.frames);
  check_truth(input);
  std::optional<OutputFolder> output;
  if (options.output) output.emplace(*options.output);
  PlaceRecognitionTest test(input.camera, options.test);
  if (const int without_pose = run_test(options, input, test); without_pose > 0) {
    fmt::print(stderr, "stdc-slam: {}: {} views have no pose within 20 ms and are left out\n",
               input.truth_path().string(), without_pose);
  }
  const PlaceScores scores = score_places(test.answers(), options.test);
  if (output) {
    output->write("places.csv", format_answers(test.answers()));
    output->write("places.png", encode_png(draw_curve(scores, input.name)));
    output->commit();
  }
  fmt::print("{}",
             options.json ? to_json(scores, test).dump(2) + "\n" : format_scores(scores, test, options.test));
}

}  // namespace

void add_places_command(Command program) {
  auto options = std::make_shared<Options>();
  Command command =
      program.add_subcommand("places", "Precision and recall of place recognition against poses");
  command.add_option("SEQUENCE", options->sequence, "Folder in TUM RGB-D layout with groundtruth.txt")
      .required();
  command.add_option("--frames", options->frames, "Only frames A..B-1: \"A:B\", either may be missing");
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
  command.add_option("--camera", options->camera, "Camera file; goes before the camera of the folder");
  command.add_option("--output", options->output, "Folder for places.csv and places.png (the curve)");
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
