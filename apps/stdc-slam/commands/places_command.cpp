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
#include "run/output_folder.hpp"
#include "run/progress.hpp"
#include "run/sequence_input.hpp"

namespace stdc::app {
namespace {

struct Options {
  std::string sequence, frames;
  std::optional<std::string> camera, output;
  int step = 5;
  PlaceRecognitionTestSettings trial;
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

void run_trial(const Options& options, const SequenceInput& input, PlaceRecognitionTest& trial) {
  const auto step = static_cast<std::size_t>(options.step);
  const std::size_t views = (input.frames.size() + step - 1) / step;
  Progress progress("recognising", "views", static_cast<int>(views), options.quiet);
  for (std::size_t i = 0; i < input.frames.size(); i += step) {
    const SequenceFrame& files = input.frames[i];
    const auto pose = pose_at(*input.truth, files.timestamp);
    if (pose) {
      trial.add(input.first_frame + static_cast<int>(i), load_frame(files, input.camera, ColourMode::grey),
                *pose);
    }
    progress.update(static_cast<int>(i / step) + 1);
  }
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double percent(int part, int whole) { return whole > 0 ? 100.0 * part / whole : 0.0; }

std::string format_scores(const PlaceScores& scores, const PlaceRecognitionTest& trial,
                          const PlaceRecognitionTestSettings& settings) {
  std::string text =
      fmt::format("{} views; {} see at least {:.0f} % of a view that is {:g} s older or more\n", scores.views,
                  scores.possible, 100 * settings.overlap, settings.gap);
  text +=
      fmt::format("first answer right:      {:6.1f} %   among the first five {:.1f} %\n",
                  percent(scores.first_right, scores.possible), percent(scores.five_right, scores.possible));
  text += fmt::format(
      "average precision:       {:6.3f}     recall at 100 % precision {:.1f} % (score above {:.4f})\n",
      scores.first.average_precision, 100 * scores.first.recall_without_error, scores.first.best_wrong_score);
  const int verified = scores.verified_right + scores.verified_wrong;
  text +=
      fmt::format("verified: precision      {:6.1f} %   recall {:.1f} %   ({} right, {} wrong)\n",
                  percent(scores.verified_right, verified), percent(scores.verified_right, scores.possible),
                  scores.verified_right, scores.verified_wrong);
  text += fmt::format("their poses: worst error {:6.1f} mm  {:.2f} degrees\n", 1e3 * scores.worst_error_m,
                      57.29577951308232 * scores.worst_error_rad);
  text += fmt::format("CPU time, medians:       {:6.2f} ms a query, {:.2f} ms a verification\n",
                      median(trial.query_ms()), median(trial.verify_ms()));
  return text;
}

nlohmann::json to_json(const PlaceScores& scores, const PlaceRecognitionTest& trial) {
  return {{"views", scores.views},
          {"possible", scores.possible},
          {"first_right", scores.first_right},
          {"five_right", scores.five_right},
          {"average_precision", scores.first.average_precision},
          {"recall_without_error", scores.first.recall_without_error},
          {"best_wrong_score", scores.first.best_wrong_score},
          {"verified_right", scores.verified_right},
          {"verified_wrong", scores.verified_wrong},
          {"worst_error_m", scores.worst_error_m},
          {"worst_error_rad", scores.worst_error_rad},
          {"query_ms", median(trial.query_ms())},
          {"verify_ms", median(trial.verify_ms())}};
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
    plot.dot({0.01 * percent(scores.verified_right, scores.possible),
              0.01 * percent(scores.verified_right, verified)},
             7, red);
  }
  plot.finish_area();
  plot.legend_line("by score alone", 2.5, blue);
  if (verified > 0) plot.legend_dot("verified", 7, red);
  plot.legend_text(fmt::format("{} views", scores.views));
  plot.legend_text(fmt::format("{} see a place again", scores.possible));
  return plot.image();
}

std::string format_answers(const std::vector<PlaceAnswer>& answers) {
  std::string text = "frame,best_overlap,found,score,overlap,overlap_of_five,verified,error_m,error_rad\n";
  for (const PlaceAnswer& a : answers) {
    text += fmt::format("{},{:.4f},{},{:.6f},{:.4f},{:.4f},{},{:.5f},{:.5f}\n", a.frame, a.best_overlap,
                        a.found ? std::to_string(*a.found) : "", a.score, a.overlap, a.overlap_of_five,
                        a.verified ? 1 : 0, a.error_m, a.error_rad);
  }
  return text;
}

void run(const Options& options) {
  const SequenceInput input(options.sequence, options.camera, options.frames);
  if (!input.truth) {
    throw Error(options.sequence, "has no groundtruth.txt",
                "places can only be judged where poses are known");
  }
  std::optional<OutputFolder> output;
  if (options.output) output.emplace(*options.output);
  PlaceRecognitionTest trial(input.camera, options.trial);
  run_trial(options, input, trial);
  const PlaceScores scores = score_places(trial.answers(), options.trial);
  if (output) {
    output->write("places.csv", format_answers(trial.answers()));
    output->write("places.png", encode_png(draw_curve(scores, input.name)));
    output->commit();
  }
  fmt::print("{}", options.json ? to_json(scores, trial).dump(2) + "\n"
                                : format_scores(scores, trial, options.trial));
}

}  // namespace

void add_places_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("places", "Precision and recall of place recognition against poses");
  command->add_option("SEQUENCE", options->sequence, "Folder in TUM RGB-D layout with groundtruth.txt")
      ->required();
  command->add_option("--frames", options->frames, "Only frames A..B-1: \"A:B\", either may be missing");
  command->add_option("--step", options->step, "Every how many frames there is a view")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--gap", options->trial.gap, "Seconds for which a place must have been left")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command
      ->add_option("--overlap", options->trial.overlap,
                   "Share of the view that must have been seen before for there to be a place to find")
      ->check(CLI::Range(PlaceRecognitionTest::kRight, 1.0))
      ->capture_default_str();
  command->add_option("--camera", options->camera, "Camera file; goes before the camera of the folder");
  command->add_option("--output", options->output, "Folder for places.csv and places.png (the curve)");
  command->add_flag("--json", options->json, "Print JSON");
  command->add_flag("--quiet", options->quiet, "No progress");
  command->footer(R"(
Each view asks for its place among the views before it. An answer is right if a tenth of the view's points, by
the true poses and the depths, is seen by it too. By score alone, and verified: matched, aligned, and refined as
a loop is; a verified pose is wrong if it is further off than 20 cm or 10 degrees.

Examples:
  stdc-slam places static-room
  stdc-slam places rgbd_dataset_freiburg1_room --step 10 --output results)");
  command->callback([options] { run(*options); });
}

}  // namespace stdc::app
