#include "report/evaluation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "report/json/frames_json.hpp"
#include "report/json/path_json.hpp"
#include "report/pictures/svg_plot.hpp"
#include "report/score_report.hpp"

namespace stdc::app {
namespace {

constexpr const char* kTruth = "#8b939c";
constexpr const char* kEstimate = "#0072b2";
constexpr double kMaxGap = 0.25;  // [s], across which no line is drawn

ReportPaths paths_of(const Evaluation& evaluation) {
  ReportPaths paths;
  paths.estimate = evaluation.estimate;
  paths.truth = evaluation.truth;
  paths.truth_from_estimate = evaluation.scores.truth_from_estimate;
  paths.errors = evaluation.errors;
  return paths;
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

std::vector<std::string> warnings_of(const Evaluation& evaluation) {
  const TrajectoryScores& scores = evaluation.scores;
  std::vector<std::string> lines;
  if (scores.coverage && *scores.coverage < 0.99) {
    lines.push_back(
        fmt::format("The estimate covers {:.1f} % of the time of the ground truth: a small error over part "
                    "of the path says little.",
                    100 * *scores.coverage));
  }
  if (scores.off_by_5_cm > 0) {
    lines.push_back(
        fmt::format("{} of {} poses are more than 5 cm off the ground truth, the worst {:.0f} cm.",
                    scores.off_by_5_cm, scores.pairs, 100 * scores.ate.maximum));
  }
  if (std::string warning = scale_warning(scores); !warning.empty()) lines.push_back(std::move(warning));
  return lines;
}

/// A path as points, with breaks in its gaps; `pick` makes a point of a drawn position and a time.
template <typename Draw, typename Pick>
std::vector<Eigen::Vector2d> points_of(const Trajectory& path, const Draw& draw, const Pick& pick) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0 && path[i].timestamp - path[i - 1].timestamp > kMaxGap) {
      points.push_back(Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
    }
    points.push_back(pick(draw(path[i].world_from_cam.translation), path[i].timestamp));
  }
  return points;
}

SvgAxes axes_around(const std::vector<std::vector<Eigen::Vector2d>>& lists, const std::string& x,
                    const std::string& y, bool equal) {
  SvgAxes axes{Eigen::Vector2d::Constant(std::numeric_limits<double>::max()),
               Eigen::Vector2d::Constant(std::numeric_limits<double>::lowest()), x, y, equal};
  for (const auto& list : lists) {
    for (const Eigen::Vector2d& point : list) {
      if (!point.allFinite()) continue;
      axes.low = axes.low.cwiseMin(point);
      axes.high = axes.high.cwiseMax(point);
    }
  }
  const Eigen::Vector2d margin = (0.05 * (axes.high - axes.low)).cwiseMax(0.005);
  axes.low -= margin;
  axes.high += margin;
  return axes;
}

/// The plan: each pose in the colour of its error.
SvgPlot plan_plot(const Evaluation& evaluation, const DrawingFrame& frame, const Trajectory& truth) {
  const auto flat = [](const Eigen::Vector3d& drawn, double) {
    return Eigen::Vector2d(drawn.x(), drawn.y());
  };
  const auto of_truth = [&](const Eigen::Vector3d& p) { return frame.of_truth(p); };
  const auto true_points = points_of(truth, of_truth, flat),
             points = points_of(evaluation.estimate, frame, flat);
  const nlohmann::ordered_json names = frame.names();
  SvgPlot plot({80, 90, 480, 480}, axes_around({true_points, points}, names["x"].get<std::string>() + " [m]",
                                               names["y"].get<std::string>() + " [m]", true));
  plot.line(true_points, 4, kTruth);
  plot.line(points, 1, kEstimate);
  constexpr int kColours = 32;
  const std::vector<std::string> colours = viridis(kColours);
  std::vector<std::vector<Eigen::Vector2d>> groups(kColours);
  const double largest = std::max(1e-9, evaluation.scores.ate.maximum);
  auto pose = evaluation.estimate.begin();
  for (const PoseError& error : evaluation.errors) {
    while (pose != evaluation.estimate.end() && pose->timestamp < error.timestamp) ++pose;
    if (pose == evaluation.estimate.end()) break;
    const auto group =
        std::min<std::size_t>(kColours - 1, static_cast<std::size_t>(kColours * error.distance / largest));
    groups[group].push_back(flat(frame(pose->world_from_cam.translation), 0));
  }
  for (std::size_t i = 0; i < groups.size(); ++i) plot.dots(groups[i], 2, colours[i]);
  plot.legend("ground truth", kTruth);
  plot.legend("estimate, coloured by its error", kEstimate);
  plot.colour_bar(colours, "0 mm", fmt::format("{:.1f} mm", 1e3 * largest));
  return plot;
}

}  // namespace

nlohmann::ordered_json evaluation_json(const Evaluation& evaluation) {
  nlohmann::ordered_json run = {{"name", evaluation.truth_name},
                                {"label", file_name(evaluation.estimate_name)},
                                {"summary", {{"scores", scores_to_json(evaluation.scores)}}},
                                {"warnings", warnings_of(evaluation)}};
  run["facts"] = nlohmann::ordered_json::array();
  run["facts"].push_back({"ground truth", evaluation.truth_name});
  run["facts"].push_back({"estimate", evaluation.estimate_name});
  add_errors(run, evaluation.errors);
  add_paths(run, paths_of(evaluation), evaluation.errors.front().timestamp);
  return run;
}

std::string evaluation_svg(const Evaluation& evaluation) {
  const DrawingFrame frame(paths_of(evaluation));
  Trajectory truth;
  for (const StampedPose& pose : evaluation.truth) {
    const bool common = pose.timestamp >= evaluation.estimate.front().timestamp &&
                        pose.timestamp <= evaluation.estimate.back().timestamp;
    if (common) truth.push_back(pose);
  }
  const double start = evaluation.errors.front().timestamp;
  std::vector<Eigen::Vector2d> errors;
  for (const PoseError& error : evaluation.errors)
    errors.emplace_back(error.timestamp - start, 1e3 * error.distance);
  SvgAxes error_axes = axes_around({errors}, "time [s]", "error [mm]", false);
  error_axes.low.y() = 0;
  SvgPlot error_plot({720, 90, 480, 190}, error_axes);
  error_plot.line(errors, 1.5, kEstimate);
  const auto height = [&](const Eigen::Vector3d& drawn, double time) {
    return Eigen::Vector2d(time - start, drawn.z());
  };
  const auto of_truth = [&](const Eigen::Vector3d& p) { return frame.of_truth(p); };
  const auto true_heights = points_of(truth, of_truth, height),
             heights = points_of(evaluation.estimate, frame, height);
  SvgPlot height_plot({720, 380, 480, 190},
                      axes_around({true_heights, heights}, "time [s]",
                                  frame.names()["z"].get<std::string>() + " [m]", false));
  height_plot.line(true_heights, 4, kTruth);
  height_plot.line(heights, 1.5, kEstimate);
  const std::string title = fmt::format("{}: ATE {:.2f} mm RMSE, median {:.2f}, largest {:.2f} ({} poses)",
                                        file_name(evaluation.estimate_name), 1e3 * evaluation.scores.ate.rmse,
                                        1e3 * evaluation.scores.ate.median,
                                        1e3 * evaluation.scores.ate.maximum, evaluation.scores.pairs);
  return svg_drawing(1230, 630, title, {plan_plot(evaluation, frame, truth), error_plot, height_plot});
}

}  // namespace stdc::app
