#include "report/calibration_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "input/camera_file.hpp"

namespace stdc::app {
namespace {

/// A value as people and the camera file have it.
struct CalibrationRow {
  std::string key;
  double given = 0, value = 0, sigma = 0;
  bool seen = false;
  const char* unit = "";
  int decimals = 4;
  const char* why_not = "";  ///< what a recording must have to show it
};

CalibrationRow row_of(const CalibratedValue& estimate, const Camera& given) {
  CalibrationRow row;
  row.given = estimate.given, row.value = estimate.value, row.sigma = estimate.sigma,
  row.seen = estimate.seen;
  switch (estimate.parameter) {
    case CalibrationParameter::depth_time_offset:
      row.key = "depth_time_offset", row.unit = "s", row.why_not = "move the camera faster, near to things";
      break;
    case CalibrationParameter::readout_time:
      row.key = "readout_time", row.unit = "s", row.why_not = "turn the camera faster, up and down as well";
      break;
    case CalibrationParameter::focal_length:
      row.key = "fx", row.unit = "px", row.decimals = 2;
      row.given *= given.fx, row.value *= given.fx, row.sigma *= given.fx;
      row.why_not = "turn the camera in all directions, at several distances from things";
      break;
    case CalibrationParameter::cx:
    case CalibrationParameter::cy:
      row.key = estimate.parameter == CalibrationParameter::cx ? "cx" : "cy";
      row.unit = "px", row.decimals = 2;
      row.why_not = "turn the camera in all directions, and about its axis";
      break;
  }
  return row;
}

std::vector<CalibrationRow> rows_of(const CalibrationRecord& record) {
  std::vector<CalibrationRow> rows;
  for (const CalibratedValue& estimate : record.calibration.estimates) {
    rows.push_back(row_of(estimate, record.given.colour));
    if (estimate.parameter != CalibrationParameter::focal_length) continue;
    CalibrationRow fy = rows.back();
    const double ratio = record.given.colour.fy / record.given.colour.fx;
    fy.key = "fy", fy.given *= ratio, fy.value *= ratio, fy.sigma *= ratio;
    rows.push_back(fy);
  }
  if (record.scale) {
    const double units = record.found.colour.depth_units_per_metre;
    rows.push_back({"depth_units_per_metre", record.given.colour.depth_units_per_metre, units,
                    units * record.scale->sigma / record.scale->factor, true, "", 1, ""});
  }
  return rows;
}

}  // namespace

std::string calibration_text(const CalibrationRecord& record) {
  const Calibration& calibration = record.calibration;
  std::string text =
      fmt::format("{}: {} frames, {} keyframes, {} points, {} observations\n", record.name, record.frames,
                  calibration.keyframes, calibration.points, calibration.observations);
  for (const CalibrationRow& row : rows_of(record)) {
    if (row.seen) {
      text += fmt::format("{:<22} {:>10.{}f} {} +- {:.{}f} (was {:.{}f})\n", row.key, row.value, row.decimals,
                          row.unit, row.sigma, row.decimals, row.given, row.decimals);
    } else {
      text += fmt::format("{:<22} not seen in this recording: {}; stays {:.{}f} {}\n", row.key, row.why_not,
                          row.given, row.decimals, row.unit);
    }
  }
  if (!record.scale) text += fmt::format("{:<22} {}\n", "depth_units_per_metre", record.scale_source);
  return text;
}

nlohmann::ordered_json calibration_json(const CalibrationRecord& record) {
  nlohmann::ordered_json json = {{"input", record.name},
                                 {"frames", record.frames},
                                 {"keyframes", record.calibration.keyframes},
                                 {"points", record.calibration.points},
                                 {"observations", record.calibration.observations}};
  for (const CalibrationRow& row : rows_of(record)) {
    nlohmann::ordered_json value = {{"given", row.given}, {"seen", row.seen}};
    if (row.seen) value["value"] = row.value, value["sigma"] = row.sigma;
    json["values"][row.key] = std::move(value);
  }
  if (!record.scale)
    json["values"]["depth_units_per_metre"] = {{"given", record.given.colour.depth_units_per_metre},
                                               {"seen", false}};
  return json;
}

std::string calibrated_camera_file(const CalibrationRecord& record) {
  std::string text = fmt::format("# Made by stdc-slam calibrate of {} ({} frames). Standard deviations:\n",
                                 record.name, record.frames);
  for (const CalibrationRow& row : rows_of(record)) {
    if (row.seen) {
      text += fmt::format("#   {}: {:.{}f}\n", row.key, row.sigma, row.decimals);
    } else {
      text += fmt::format("#   {}: not seen in this recording\n", row.key);
    }
  }
  if (!record.scale) text += "#   depth_units_per_metre: " + record.scale_source + "\n";
  return text + format_cameras(record.found);
}

}  // namespace stdc::app
