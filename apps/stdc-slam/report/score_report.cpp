#include "report/score_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/quantiles.hpp"

namespace stdc::app {
namespace {

/// A statistic without data has no numbers.
std::string row(const char* name, const std::optional<ErrorStatistics>& errors, double factor,
                const char* unit) {
  std::string line = fmt::format("{:<28}", name);
  for (const auto value : {&ErrorStatistics::rmse, &ErrorStatistics::mean, &ErrorStatistics::median,
                           &ErrorStatistics::maximum}) {
    line += errors ? fmt::format(" {:>10.3f}", factor * (*errors).*value) : fmt::format(" {:>10}", "-");
  }
  return line + fmt::format("  {}\n", unit);
}

/// "3.1 % too small".
std::string scale_in_words(const ScaleFit& scale, int decimals) {
  const double off = 100 * (1 / scale.factor - 1);
  return fmt::format("{:.{}f} % too {}", std::abs(off), decimals, off < 0 ? "small" : "large");
}

nlohmann::ordered_json statistics_to_json(const std::optional<ErrorStatistics>& statistics) {
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
         fmt::format("{} pairs, {} of them off by more than 5 cm; coverage {} %\n", scores.pairs,
                     scores.off_by_5_cm, to_text(scores.coverage, 1, 100)) +
         scale_text(scores) + "\n";
}

std::string scale_text(const TrajectoryScores& scores) {
  return fmt::format("best scale: the estimate is {}; without that the ATE is {:.3f} mm",
                     scale_in_words(scores.scale, 2), 1e3 * scores.scale.ate_rmse);
}

std::string scale_warning(const TrajectoryScores& scores) {
  if (!scores.scale.is_suspicious(scores.ate.rmse)) return {};
  return fmt::format(
      "The trajectory is {}, which makes the ATE {:.1f} mm in place of {:.1f}: is depth_units_per_metre "
      "right? "
      "stdc-slam calibrate finds it.",
      scale_in_words(scores.scale, 1), 1e3 * scores.ate.rmse, 1e3 * scores.scale.ate_rmse);
}

nlohmann::ordered_json scores_to_json(const TrajectoryScores& scores) {
  const Eigen::Vector3d& t = scores.truth_from_estimate.translation;
  const Eigen::Quaterniond& q = scores.truth_from_estimate.rotation;
  return {{"pairs", scores.pairs},
          {"off_by_5_cm", scores.off_by_5_cm},
          {"coverage", to_json(scores.coverage)},
          {"ate_m", statistics_to_json(scores.ate)},
          {"rpe_frame_translation_m", statistics_to_json(scores.rpe_frame_translation)},
          {"rpe_frame_rotation_deg", statistics_to_json(scores.rpe_frame_rotation)},
          {"rpe_second_translation_m", statistics_to_json(scores.rpe_second_translation)},
          {"rpe_second_rotation_deg", statistics_to_json(scores.rpe_second_rotation)},
          {"scale", {{"factor", scores.scale.factor}, {"ate_rmse_m", scores.scale.ate_rmse}}},
          {"truth_from_estimate",
           {{"translation_m", {t.x(), t.y(), t.z()}}, {"rotation_xyzw", {q.x(), q.y(), q.z(), q.w()}}}}};
}

}  // namespace stdc::app
