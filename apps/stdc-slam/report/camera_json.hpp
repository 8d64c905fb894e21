#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace stdc::app {

/// The lines of a camera file as an object: numbers, and the name of the lens.
nlohmann::ordered_json camera_to_json(const std::string& camera_file);

}  // namespace stdc::app
