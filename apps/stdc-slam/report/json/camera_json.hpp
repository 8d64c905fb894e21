#pragma once

#include <nlohmann/json_fwd.hpp>

#include "input/rgbd_cameras.hpp"

namespace stdc::app {

/// The lines of a camera file as an object: numbers, and the name of the lens.
nlohmann::ordered_json camera_to_json(const Camera& camera);
/// The same with `depth_camera`, if there is one.
nlohmann::ordered_json cameras_to_json(const RgbdCameras& cameras);

}  // namespace stdc::app
