#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "calibration/calibrate.hpp"
#include "calibration/depth_scale.hpp"
#include "input/rgbd_cameras.hpp"

namespace stdc::app {

/// What `calibrate` found of an input.
struct CalibrationRecord {
  std::string name;  ///< of the input
  int frames = 0;
  RgbdCameras given, found;
  Calibration calibration;
  std::optional<DepthScale> scale;
  std::string scale_source;  ///< "the true poses", "the distance"; or why there is no scale
};

/// For people, a line for each value.
std::string calibration_text(const CalibrationRecord& record);
nlohmann::ordered_json calibration_json(const CalibrationRecord& record);
/// The camera file, with the standard deviations as comments.
std::string calibrated_camera_file(const CalibrationRecord& record);

}  // namespace stdc::app
