#include <algorithm>
#include <cstdlib>

#include "commands.hpp"

namespace stdc::ros2_peer {

std::string value_of(const std::vector<std::string>& words, const std::string& option,
                     const std::string& otherwise) {
  const auto found = std::find(words.begin(), words.end(), option);
  return found == words.end() || found + 1 == words.end() ? otherwise : *(found + 1);
}

bool has(const std::vector<std::string>& words, const std::string& option) {
  return std::find(words.begin(), words.end(), option) != words.end();
}

int domain() {
  const char* text = std::getenv("ROS_DOMAIN_ID");
  return text == nullptr ? 0 : std::atoi(text);
}

}  // namespace stdc::ros2_peer
