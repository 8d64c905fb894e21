#include "report/run_report.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "report/json/frames_json.hpp"
#include "report/json/series_json.hpp"
#include "report/run_warnings.hpp"
#include "run/command_line.hpp"
#include "slam/settings_io.hpp"

namespace stdc::app {
namespace {

using Json = nlohmann::ordered_json;

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t packet = 0;
    for (std::size_t k = 0; k < 3; ++k) packet = (packet << 8U) | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[(packet >> (18 - 6 * k)) & 63U] : '=';
  }
  return text;
}

/// All settings; those that are not the default with what that is.
Json settings_json(const Settings& settings) {
  Json list = Json::array();
  const std::vector<SettingText> usual = list_settings({});
  const std::vector<SettingText> now = list_settings(settings);
  for (std::size_t i = 0; i < now.size(); ++i) {
    Json& entry = list.emplace_back(Json{{"name", now[i].section + "." + now[i].name},
                                         {"value", now[i].value},
                                         {"unit", now[i].unit},
                                         {"description", now[i].description}});
    if (now[i].value != usual[i].value) entry["usual"] = usual[i].value;
  }
  return list;
}

/// Where the camera was at a time, in the plan.
Json place_at(const ReportPaths& paths, const DrawingFrame& frame, double timestamp) {
  const auto found = std::lower_bound(paths.estimate.begin(), paths.estimate.end(), timestamp,
                                      [](const StampedPose& pose, double t) { return pose.timestamp < t; });
  if (found == paths.estimate.end() || found->timestamp != timestamp) return nullptr;
  const Eigen::Vector3d drawn = frame(found->world_from_cam.translation);
  return {rounded(drawn.x(), 4), rounded(drawn.y(), 4)};
}

Json loops_json(const RunReport& report) {
  const std::vector<TrackingResult>& results = report.record.results();
  const DrawingFrame frame(report.paths);
  const auto place = [&](int number) -> Json {
    if (!report.own_frames || number < 0 || number >= static_cast<int>(results.size())) return nullptr;
    return place_at(report.paths, frame, results[static_cast<std::size_t>(number)].timestamp);
  };
  Json list = Json::array();
  for (const LoopRecord::Entry& entry : report.record.loops().entries()) {
    const LoopReport& loop = entry.report;
    Json& one = list.emplace_back(Json{{"merged", loop.merged},
                                       {"frame", loop.frame + report.summary.first_frame},
                                       {"matched_frame", loop.matched_frame + report.summary.first_frame},
                                       {"keyframes", loop.keyframes},
                                       {"fused", loop.fused},
                                       {"drift_m", rounded(loop.drift, 5)},
                                       {"detection_ms", rounded(loop.detection_ms, 2)},
                                       {"correction_ms", rounded(loop.correction_ms, 2)}});
    one["time"] = entry.timestamp ? Json(rounded(*entry.timestamp - results.front().timestamp, 4)) : nullptr;
    one["from"] = place(loop.frame);
    one["to"] = place(loop.matched_frame);
  }
  return list;
}

Json sample_images_json(const SampleFrames& samples, double first_time) {
  Json list = Json::array();
  for (const SampleFrame& frame : samples.frames()) {
    list.push_back({{"frame", frame.number},
                    {"time", rounded(frame.timestamp - first_time, 4)},
                    {"text", frame.text},
                    {"uri", "data:image/jpeg;base64," + base64(frame.jpeg)}});
  }
  return list;
}

std::vector<std::string> depth_lines(const RunReport& report) {
  const std::optional<DepthLook> look = report.samples != nullptr ? report.samples->depth() : std::nullopt;
  if (!look) return {};
  std::optional<double> units;
  if (!report.samples->depth_in_metres()) units = report.summary.cameras.colour.depth_units_per_metre;
  return depth_warnings(*look, units);
}

}  // namespace

Json run_json(RunReport report) {
  const TrajectoryScores* const scores =
      report.summary.score.scores ? &*report.summary.score.scores : nullptr;
  if (scores != nullptr) {
    report.paths.truth_from_estimate = scores->truth_from_estimate;
    report.paths.errors = pose_errors(report.paths.truth, report.paths.estimate, scores->truth_from_estimate);
  }
  Json run = {{"name", report.summary.sequence}, {"label", report.summary.sequence}};
  run["facts"] = Json::array();
  for (const auto& [name, value] : report.facts) run["facts"].push_back({name, value});
  run["summary"] = summary_to_json(report.summary, report.record, report.settings);
  run["summary"].erase("settings");  // they are below, with their meaning
  run["warnings"] = run_warnings(report.summary, report.record, depth_lines(report));
  run["settings"] = settings_json(report.settings);
  add_frames(run, report.record, report.paths.errors);
  if (report.record.results().empty()) return run;
  const double first_time = report.record.results().front().timestamp;
  add_paths(run, report.paths, first_time);
  run["loops"] = loops_json(report);
  if (report.samples != nullptr) run["images"] = sample_images_json(*report.samples, first_time);
  return run;
}

std::vector<std::pair<std::string, std::string>> process_facts() {
  std::error_code failed;
  return {{"machine", machine_name()},
          {"program", std::string("stdc-slam ") + STDC_VERSION},
          {"working folder", std::filesystem::current_path(failed).string()}};
}

Json report_of(const std::string& title, const std::string& subtitle, Json groups,
               const std::vector<std::string>& commands) {
  return {{"title", title},
          {"subtitle", subtitle},
          {"machine", machine_name()},
          {"groups", std::move(groups)},
          {"commands", commands}};
}

}  // namespace stdc::app
