#include "report/info_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "input/open_source.hpp"
#include "report/json/camera_json.hpp"
#include "report/report_page.hpp"

namespace stdc::app {
namespace {

std::string line(const char* title, const std::string& text) {
  return fmt::format("{:<13}{}\n", title, text);
}

std::string streams_text(const InputSurvey& survey) {
  std::string text;
  for (const StreamInfo& stream : survey.streams) {
    text += line(text.empty() ? "streams" : "",
                 fmt::format("{}: {}{}{}", stream.name, stream.content,
                             stream.count ? fmt::format(", {}", *stream.count) : "",
                             stream.used ? "" : " (not read)"));
  }
  return text;
}

std::string times_text(const InputSurvey& survey) {
  const SurveyTimes& t = survey.times;
  std::string frames = fmt::format("{}", t.frames);
  if (t.frames > 1) {
    frames +=
        fmt::format(" in {:.2f} s: {:.1f} a second; 95 % of the intervals are {:.1f} ms within {:.1f} ms",
                    t.duration(), t.rate(), 1e3 * t.interval, 1e3 * t.jitter);
  }
  if (survey.colour_without_depth > 0) {
    frames += fmt::format("; {} more colour images without depth", survey.colour_without_depth);
  }
  std::string text = line("frames", frames);
  text += line("gaps", t.gaps == 0 ? "none"
                                   : fmt::format("{}, the longest {:.2f} s after {:.2f} s", t.gaps,
                                                 t.longest_gap, t.gap_at - t.first));
  if (t.frames > 0) {
    std::string offset = fmt::format("{:+.1f} ms from colour (median), 95 % within {:.1f} ms of that",
                                     1e3 * t.depth_offset, 1e3 * t.depth_offset_spread);
    if (survey.cameras && survey.cameras->depth_time_offset != 0) {
      offset += fmt::format("; with the camera's depth_time_offset of {:+.1f} ms",
                            1e3 * survey.cameras->depth_time_offset);
    }
    text += line("depth time", offset);
  }
  return text;
}

std::string describe(const Camera& camera) {
  std::string text =
      fmt::format("{} x {}, fx {:.2f}, fy {:.2f}, cx {:.2f}, cy {:.2f}, {}", camera.width, camera.height,
                  camera.fx, camera.fy, camera.cx, camera.cy, camera.lens_name());
  return camera.readout_time > 0 ? text + fmt::format(", readout {:.1f} ms", 1e3 * camera.readout_time)
                                 : text;
}

std::string cameras_text(const InputSurvey& survey) {
  if (!survey.cameras) return line("camera", "not known");
  std::string text = line("camera", describe(survey.cameras->colour));
  if (!survey.cameras->depth) return text + line("depth camera", "the same: depth is registered");
  const DepthCamera& depth = *survey.cameras->depth;
  const Eigen::Vector3d& t = depth.colour_from_depth.translation;
  constexpr double kDegrees = 57.29577951308232;
  text += line("depth camera", describe(depth.camera));
  return text +
         line("", fmt::format("{:.1f} {:.1f} {:.1f} mm and {:.2f} degrees from the colour camera; depth is "
                              "registered when it is read",
                              1e3 * t.x(), 1e3 * t.y(), 1e3 * t.z(),
                              kDegrees * rotation_log(depth.colour_from_depth.rotation).norm()));
}

std::string images_text(const InputSurvey& survey) {
  const SurveyImages& i = survey.images;
  if (i.sampled == 0) return line("images", "none could be read");
  std::string text = line(
      "images", fmt::format("{} {} x {}, depth {} x {} ({}); {} frames looked at", i.grey ? "grey" : "colour",
                            i.colour_size.width, i.colour_size.height, i.depth_size.width,
                            i.depth_size.height, i.depth_in_metres ? "metres" : "16 bits", i.sampled));
  std::string depth = fmt::format("{:.0f} % of the pixels have one", 100 * i.valid_share);
  if (survey.cameras && survey.cameras->depth) {
    depth += fmt::format(" ({:.0f} % when registered)", 100 * i.registered_share);
  }
  const bool scaled = i.depth_in_metres || survey.cameras;
  const double unit = i.depth_in_metres ? 1
                      : survey.cameras  ? survey.cameras->colour.depth_units_per_metre
                                        : 1;
  depth += fmt::format(", median {:.3g} {}, 95 % below {:.3g}", i.median_depth / unit, scaled ? "m" : "units",
                       i.far_depth / unit);
  if (survey.cameras && !i.depth_in_metres) depth += fmt::format("; {:g} units per metre", unit);
  return text + line("depth", depth);
}

std::string truth_text(const InputSurvey& survey) {
  if (!survey.truth) return line("ground truth", "none");
  const std::string note = survey.truth->note();
  return line("ground truth", fmt::format("{} poses, {}{}", survey.truth->poses.size(), survey.truth_where,
                                          note.empty() ? "" : "; " + note));
}

nlohmann::ordered_json shift_json(const std::optional<EdgeShift>& shift) {
  if (!shift) return nullptr;
  return {{"x_px", shift->x}, {"y_px", shift->y}, {"gain", shift->gain}, {"clarity", shift->clarity}};
}

nlohmann::ordered_json times_json(const SurveyTimes& t) {
  return {{"duration_s", t.duration()},
          {"first_s", t.first},
          {"frames_per_second", t.rate()},
          {"interval_s", t.interval},
          {"jitter_s", t.jitter},
          {"gaps", t.gaps},
          {"longest_gap_s", t.longest_gap},
          {"backwards", t.backwards},
          {"depth_offset_s", t.depth_offset},
          {"depth_offset_spread_s", t.depth_offset_spread}};
}

nlohmann::ordered_json images_json(const InputSurvey& survey) {
  const SurveyImages& i = survey.images;
  const bool known = i.depth_in_metres || survey.cameras;
  const double unit = i.depth_in_metres || !survey.cameras ? 1 : survey.cameras->colour.depth_units_per_metre;
  nlohmann::ordered_json json{{"sampled", i.sampled},
                              {"unreadable", i.unreadable},
                              {"colour_size", {i.colour_size.width, i.colour_size.height}},
                              {"depth_size", {i.depth_size.width, i.depth_size.height}},
                              {"grey", i.grey},
                              {"brightness", i.brightness},
                              {"valid_depth_share", i.valid_share},
                              {"registered_depth_share", i.registered_share}};
  json["median_depth_m"] = known ? nlohmann::ordered_json(i.median_depth / unit) : nullptr;
  json["far_depth_m"] = known ? nlohmann::ordered_json(i.far_depth / unit) : nullptr;
  json["edge_shift"] = shift_json(i.edges);
  json["edge_shift_left"] = shift_json(i.left_edges);
  json["edge_shift_right"] = shift_json(i.right_edges);
  return json;
}

}  // namespace

std::string title_of_kind(const std::string& name) {
  for (const SourceKind& kind : source_kinds()) {
    if (name == kind.name) return fmt::format("{} ({})", name, kind.title);
  }
  return name;
}

std::string info_text(const InputSurvey& survey, const std::vector<std::string>& warnings) {
  std::string text =
      line("kind", title_of_kind(survey.kind)) + line("input", survey.where) + streams_text(survey) +
      times_text(survey) + images_text(survey) + cameras_text(survey) + truth_text(survey) +
      line("IMU", survey.imu_samples > 0 ? fmt::format("{} readings", survey.imu_samples) : "none");
  for (const std::string& note : survey.notes) text += line("note", note);
  for (const std::string& warning : warnings) text += line("warning", warning);
  return text;
}

std::string info_json(const InputSurvey& survey, const std::vector<std::string>& warnings) {
  nlohmann::ordered_json json{{"kind", survey.kind}, {"input", survey.where}};
  json["streams"] = nlohmann::ordered_json::array();
  for (const StreamInfo& stream : survey.streams) {
    json["streams"].push_back({{"name", stream.name}, {"content", stream.content}, {"used", stream.used}});
    json["streams"].back()["count"] = stream.count ? nlohmann::ordered_json(*stream.count) : nullptr;
  }
  json["frames"] = survey.times.frames;
  json["colour_without_depth"] = survey.colour_without_depth;
  json["times"] = times_json(survey.times);
  json["images"] = images_json(survey);
  json["camera"] = survey.cameras ? cameras_to_json(*survey.cameras) : nullptr;
  json["ground_truth"] = nullptr;
  if (survey.truth) {
    json["ground_truth"] = {{"where", survey.truth_where},
                            {"poses", survey.truth->poses.size()},
                            {"left_out", survey.truth->left_out()}};
  }
  json["imu_readings"] = survey.imu_samples;
  json["notes"] = survey.notes;
  json["warnings"] = warnings;
  return json_text(json);
}

}  // namespace stdc::app
