#include "report/camera_json.hpp"

#include <nlohmann/json.hpp>
#include <string_view>

#include "core/text_file.hpp"

namespace stdc::app {

nlohmann::ordered_json camera_to_json(const std::string& camera_file) {
  nlohmann::ordered_json camera;
  LineReader lines(camera_file);
  std::string_view line;
  while (lines.next(line)) {
    const std::size_t colon = line.find(": ");
    const std::string_view value = line.substr(colon + 2);
    nlohmann::ordered_json& entry = camera[std::string(line.substr(0, colon))];
    if (const auto number = parse_number(value)) {
      entry = *number;
    } else {
      entry = value;  // the name of the lens
    }
  }
  return camera;
}

}  // namespace stdc::app
