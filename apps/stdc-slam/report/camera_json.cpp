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
    camera[std::string(line.substr(0, colon))] = parse_number(value).value_or(0);
  }
  return camera;
}

}  // namespace stdc::app
