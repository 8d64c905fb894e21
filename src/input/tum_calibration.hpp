#pragma once

#include <optional>
#include <string_view>

#include "core/camera.hpp"

namespace stdc {

/// The calibration (lens and rolling shutter) for a folder name with "freiburg1", "freiburg2", "freiburg3" or
/// "rgbd_bonn" in it: those published with the TUM RGB-D benchmark (Sturm et al., IROS 2012) and with the
/// Bonn RGB-D dynamic dataset (Palazzolo et al., IROS 2019).
std::optional<Camera> tum_calibration(std::string_view folder_name);

}  // namespace stdc
