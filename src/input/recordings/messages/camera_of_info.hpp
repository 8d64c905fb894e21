#pragma once

#include <string>

#include "core/camera.hpp"
#include "input/recordings/messages/ros_messages.hpp"

namespace stdc {

/// The camera that a CameraInfo describes: plumb_bob (five coefficients), rational_polynomial (eight),
/// equidistant (four), or no lens at all; RealSense's names of them too. Binning and region of interest are
/// taken into account. Depth unit and rate are left as they are by default.
/// @param rectified  the images have been undistorted: P holds, without a lens
/// @param where      file and topic, for errors
/// Throws Error for a camera that was not calibrated, a lens model or coefficients that are not known here,
/// and values that do not validate.
Camera camera_of_info(const CameraInfoMessage& info, bool rectified, const std::string& where);

}  // namespace stdc
