#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/camera.hpp"
#include "input/rgbd_cameras.hpp"

namespace stdc {

/// Reads camera.yaml: keys width, height, fx, fy, cx, cy; optional lens (pinhole, radial-tangential, rational
/// or equidistant) with its coefficients: k1, k2, p1, p2, k3 (radial-tangential), these and k4, k5, k6
/// (rational), k1, k2, k3, k4 (equidistant), all 0 if not given; depth_units_per_metre (5000),
/// frames_per_second (30), readout_time (0), rotation (0: degrees clockwise that turn the image upright).
/// Without `lens` it follows from the coefficients, but is never equidistant. Throws Error (file, line) for a
/// missing or unreadable file, a missing or unknown key, a coefficient that the lens does not have, or a
/// value that does not validate, and for what needs read_cameras.
Camera read_camera(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in errors.
Camera parse_camera(const std::string& yaml, const std::string& name);
/// The same with `depth_time_offset` (0: seconds by which depth images were taken later than their stamps
/// say; whoever opens a source shifts them, see shifted_depth.hpp) and the section `depth_camera`, of depth
/// images that are not registered to the colour images: its own width, height, fx, fy, cx, cy, lens and
/// coefficients, and where it is by `translation` ([x, y, z], metres) and `quaternion` ([qx, qy, qz, qw];
/// none if not given): colour from depth camera.
RgbdCameras read_cameras(const std::filesystem::path& path);
RgbdCameras parse_cameras(const std::string& yaml, const std::string& name);
std::string format_cameras(const RgbdCameras& cameras);
/// The text that parse_camera reads back to the same camera.
std::string format_camera(const Camera& camera);

}  // namespace stdc
