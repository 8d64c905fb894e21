#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace stdc::app {

/// The lines of a camera file as an object of numbers.
nlohmann::ordered_json camera_to_json(const std::string& camera_file);

}  // namespace stdc::app
