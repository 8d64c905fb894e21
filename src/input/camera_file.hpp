#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/camera.hpp"

namespace stdc {

/// Reads camera.yaml: keys width, height, fx, fy, cx, cy, optional k1, k2, p1, p2, k3 (0),
/// depth_units_per_metre (5000), frames_per_second (30), readout_time (0). Throws Error (file, line) for a
/// missing or unreadable file, a missing or unknown key, or a value that does not validate.
Camera read_camera(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in errors.
Camera parse_camera(const std::string& yaml, const std::string& name);
/// The text that parse_camera reads back to the same camera.
std::string format_camera(const Camera& camera);
/// The calibration (lens and rolling shutter) that ships for a folder name with "freiburg1", "freiburg2" or
/// "freiburg3" in it.
std::optional<Camera> tum_calibration(std::string_view folder_name);

}  // namespace stdc
