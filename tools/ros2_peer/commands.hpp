#pragma once

#include <string>
#include <vector>

namespace stdc::ros2_peer {

// Each takes the words of the command line and gives the exit code.

int play(const std::vector<std::string>& words);
int evil(const std::vector<std::string>& words);
int send_empty(const std::vector<std::string>& words);

/// The value behind an option; `otherwise` if it is not there.
std::string value_of(const std::vector<std::string>& words, const std::string& option,
                     const std::string& otherwise);
bool has(const std::vector<std::string>& words, const std::string& option);
/// ROS_DOMAIN_ID.
int domain();

}  // namespace stdc::ros2_peer
