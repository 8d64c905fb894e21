#include "input/recordings/recording.hpp"

namespace stdc {

std::optional<int> Recording::find_topic(std::string_view name) const {
  for (std::size_t i = 0; i < topics().size(); ++i) {
    if (topics()[i].name == name) return static_cast<int>(i);
  }
  return std::nullopt;
}

std::string plain_type_name(std::string_view type) {
  constexpr std::string_view kMiddle = "/msg/";
  const std::size_t at = type.find(kMiddle);
  if (at == std::string_view::npos) return std::string(type);
  return std::string(type.substr(0, at)) + "/" + std::string(type.substr(at + kMiddle.size()));
}

}  // namespace stdc
