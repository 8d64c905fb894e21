#include <charconv>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "ros2/node_options.hpp"

namespace stdc::ros2 {

NodeOptions options_from_environment() {
  constexpr int kMaxDomain = 232;  // further ones have no ports
  NodeOptions options;
  if (const char* text = std::getenv("ROS_DOMAIN_ID"); text != nullptr && *text != '\0') {
    const char* end = text + std::strlen(text);
    const auto [rest, problem] = std::from_chars(text, end, options.domain);
    if (problem != std::errc() || rest != end || options.domain < 0 || options.domain > kMaxDomain) {
      throw Error("ROS_DOMAIN_ID", shown(text) + " is no domain", "set it to 0 ... 232, or not at all");
    }
  }
  if (const char* text = std::getenv("ROS_LOCALHOST_ONLY"); text != nullptr && *text != '\0') {
    options.localhost_only = std::strcmp(text, "1") == 0;
    if (!options.localhost_only && std::strcmp(text, "0") != 0) {
      throw Error("ROS_LOCALHOST_ONLY", shown(text) + " is neither 0 nor 1", "set it to 1, or not at all");
    }
  }
  return options;
}

}  // namespace stdc::ros2
