#include "report/score_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace stdc::app {
namespace {

std::string row(const char* name, const ErrorStatistics& errors, double factor, const char* unit) {
  return fmt::format("{:<28} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f}  {}\n", name, factor * errors.rmse,
                     factor * errors.mean, factor * errors.median, factor * errors.maximum, unit);
}

/// A statistic without data has no numbers.
std::string row(const char* name, const std::optional<ErrorStatistics>& errors, double factor,
                const char* unit) {
  if (errors) return row(name, *errors, factor, unit);
  return fmt::format("{:<28} {:>10} {:>10} {:>10} {:>10}  {}\n", name, "-", "-", "-", "-", unit);
}

nlohmann::ordered_json to_json(const std::optional<ErrorStatistics>& statistics) {
  if (!statistics) return {{"rmse", nullptr}, {"mean", nullptr}, {"median", nullptr}, {"max", nullptr}};
  const ErrorStatistics& errors = *statistics;
  return {{"rmse", errors.rmse}, {"mean", errors.mean}, {"median", errors.median}, {"max", errors.maximum}};
}

}  // namespace

std::string format_scores(const TrajectoryScores& scores) {
  constexpr double kMillimetres = 1e3;
  return fmt::format("{:<28} {:>10} {:>10} {:>10} {:>10}\n", "", "rmse", "mean", "median", "max") +
         row("ATE", scores.ate, kMillimetres, "mm") +
         row("RPE per frame, translation", scores.rpe_frame_translation, kMillimetres, "mm") +
         row("RPE per frame, rotation", scores.rpe_frame_rotation, 1, "deg") +
         row("RPE per second, translation", scores.rpe_second_translation, kMillimetres, "mm") +
         row("RPE per second, rotation", scores.rpe_second_rotation, 1, "deg") +
         fmt::format("{} pairs, coverage {:.1f} %\n", scores.pairs, 100 * scores.coverage);
}

nlohmann::ordered_json scores_to_json(const TrajectoryScores& scores) {
  const Eigen::Vector3d& t = scores.truth_from_estimate.translation;
  const Eigen::Quaterniond& q = scores.truth_from_estimate.rotation;
  return {{"pairs", scores.pairs},
          {"coverage", scores.coverage},
          {"ate_m", to_json(scores.ate)},
          {"rpe_frame_translation_m", to_json(scores.rpe_frame_translation)},
          {"rpe_frame_rotation_deg", to_json(scores.rpe_frame_rotation)},
          {"rpe_second_translation_m", to_json(scores.rpe_second_translation)},
          {"rpe_second_rotation_deg", to_json(scores.rpe_second_rotation)},
          {"truth_from_estimate",
           {{"translation_m", {t.x(), t.y(), t.z()}}, {"rotation_xyzw", {q.x(), q.y(), q.z(), q.w()}}}}};
}

}  // namespace stdc::app
