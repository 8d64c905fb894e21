#include "report/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/json/camera_json.hpp"
#include "report/report_page.hpp"
#include "report/score_report.hpp"

namespace stdc::app {
namespace {

using Json = nlohmann::ordered_json;

/// A setting's or camera's value: enums by their words, all else as JSON has it.
template <typename T>
Json value_to_json(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return std::string(enum_name(value));
  } else {
    return value;
  }
}

Json settings_to_json(const Settings& settings) {
  Json all;
  for_each_section(settings, [&](const char* name, const auto& section) {
    Json& entries = all[name];
    for_each_setting(section, [&](const Setting& setting, const auto& value) {
      entries[setting.name] = value_to_json(value);
    });
  });
  return all;
}

Json mask_scores_to_json(const MaskRunScore& masks) {
  const MaskScores scores = score_mask(masks.counts);
  return {{"frames", masks.frames},
          {"iou", to_json(scores.iou)},
          {"precision", to_json(scores.precision)},
          {"recall", to_json(scores.recall)},
          {"boundary_f", to_json(scores.boundary_f)}};
}

Json dense_to_json(const DenseSummary& dense) {
  return {{"files", dense.files},
          {"views", dense.views},
          {"vertices", dense.vertices},
          {"triangles", dense.triangles},
          {"voxel_m", dense.voxel},
          {"cpu_ms_per_frame", dense.cpu_ms_per_frame},
          {"cpu_seconds", dense.cpu_seconds}};
}

double coverage(const RunSummary& summary, const RunRecord& record) {
  return static_cast<double>(summary.poses) / std::max(1, record.counts().total());
}

double frames_per_second(const RunRecord& record) {
  return record.counts().total() / std::max(record.processing_seconds(), 1e-3);
}

}  // namespace

Json summary_to_json(const RunSummary& summary, const RunRecord& record, const Settings& settings) {
  const StatusCounts& counts = record.counts();
  Json json = {
      {"version", STDC_VERSION},
      {"sequence", summary.sequence},
      {"first_frame", summary.first_frame},
      {"frames",
       {{"total", counts.total()},
        {"ok", counts.ok},
        {"uncertain", counts.uncertain},
        {"lost", counts.lost},
        {"initialising", counts.initialising},
        {"skipped", counts.skipped},
        {"colour_without_depth", summary.colour_without_depth}}},
      {"coverage", coverage(summary, record)},
      {"maps", summary.maps},
      {"loops", record.loops().loops()},
      {"merges", record.loops().merges()},
      {"keyframes", summary.keyframes},
      {"landmarks", summary.landmarks},
      {"start_up_seconds", record.start_up_seconds()},
      {"processing_seconds", record.processing_seconds()},
      {"frames_per_second", frames_per_second(record)},
      {"cpu_seconds", summary.usage.cpu_seconds},
      {"peak_memory_mb", summary.usage.peak_memory_mb},
      {"stage_milliseconds", record.stage_milliseconds()},
      {"mapping", record.mapping()},
      {"loop_closing", record.loops().to_json()},
      {"segmentation", record.segmentation()},
      {"motion", record.motion()},
  };
  if (!record.lags().empty()) json["realtime_lag_ms"] = to_json(quantiles(record.lags()));
  if (summary.truth) {
    json["groundtruth"] = {{"rows", summary.truth->rows},
                           {"convention", summary.score.convention.note()},
                           {"left_out", summary.truth->left_out()},
                           {"reasons",
                            {{"without_pose", summary.truth->without_pose},
                             {"malformed", summary.truth->malformed},
                             {"repeated", summary.truth->repeated}}}};
  }
  if (summary.score.scores) json["scores"] = scores_to_json(*summary.score.scores);
  if (summary.consistency) {
    // Squared errors over the covariances, per degree of freedom: 1 is expected.
    json["pose_consistency"] = {{"poses", summary.consistency->poses},
                                {"position", summary.consistency->position},
                                {"rotation", summary.consistency->rotation},
                                {"beyond_95_percent", summary.consistency->beyond}};
  }
  if (summary.masks) json["mask_scores"] = mask_scores_to_json(*summary.masks);
  if (summary.dense) json["dense"] = dense_to_json(*summary.dense);
  if (!summary.score.not_scored.empty()) json["not_scored"] = summary.score.not_scored;
  json["camera"] = cameras_to_json(summary.cameras);
  json["settings"] = settings_to_json(settings);
  return json;
}

std::string summary_json(const RunSummary& summary, const RunRecord& record, const Settings& settings) {
  return json_text(summary_to_json(summary, record, settings));
}

std::string summary_text(const RunSummary& summary, const RunRecord& record) {
  const StatusCounts& counts = record.counts();
  const Quantiles tracking = record.stage(&StageTimes::total), cpu = record.stage(&StageTimes::total_cpu);
  std::string text = fmt::format("{}: {} frames, {} with a pose ({:.1f} %)", summary.sequence, counts.total(),
                                 summary.poses, 100 * coverage(summary, record));
  if (summary.poses_elsewhere > 0) text += fmt::format(", {} in other maps", summary.poses_elsewhere);
  if (counts.uncertain > 0) text += fmt::format(", {} uncertain", counts.uncertain);
  if (counts.lost > 0) text += fmt::format(", {} lost", counts.lost);
  if (counts.initialising > 0) text += fmt::format(", {} initialising", counts.initialising);
  if (counts.skipped > 0) text += fmt::format(", {} skipped", counts.skipped);
  text += fmt::format("; {} keyframes, {} landmarks\n", summary.keyframes, summary.landmarks);
  text +=
      fmt::format("{:.1f} frames a second; tracking {} ms a frame (median; 95 %: {}, 99 %: {}; CPU: {})\n",
                  frames_per_second(record), to_text(tracking.median, 1), to_text(tracking.p95, 1),
                  to_text(tracking.p99, 1), to_text(cpu.median, 1));
  if (summary.maps > 1) text += fmt::format("{} maps that were not joined\n", summary.maps);
  text += record.loops().text();
  text += record.segmentation_text();
  if (summary.masks) {
    const MaskScores masks = score_mask(summary.masks->counts);
    text += fmt::format(
        "masks of what moves against the true ones: IoU {}, precision {}, recall {} % ({} frames)\n",
        to_text(masks.iou, 1, 100), to_text(masks.precision, 1, 100), to_text(masks.recall, 1, 100),
        summary.masks->frames);
  }
  text += fmt::format("CPU {:.1f} s in all, peak memory {:.0f} MB, first frame after {:.2f} s\n",
                      summary.usage.cpu_seconds, summary.usage.peak_memory_mb, record.start_up_seconds());
  if (summary.score.scores) text.append("\n").append(format_scores(*summary.score.scores));
  if (!summary.score.not_scored.empty()) text += fmt::format("not scored: {}\n", summary.score.not_scored);
  return text;
}

}  // namespace stdc::app
