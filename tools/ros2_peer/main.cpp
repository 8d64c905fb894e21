// ros2_peer: the other side of a ROS 2 system, for tests and measurements of `stdc-slam ros2`. Built on
// Cyclone DDS, with messages from Debian's ros-*-msgs packages: neither library nor message definitions are
// shared with what it tests.
//
//   ros2_peer play FOLDER [options]   plays a sequence, listens to what comes back
//   ros2_peer evil TOPIC KIND         sends what no camera sends: wrong-type, lying-type, truncated, flood
//   ros2_peer send TOPIC              sends one std_msgs/Empty
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "commands.hpp"

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() >= 2 && words[0] == "play") return stdc::ros2_peer::play(words);
    if (words.size() >= 3 && words[0] == "evil") return stdc::ros2_peer::evil(words);
    if (words.size() >= 2 && words[0] == "send") return stdc::ros2_peer::send_empty(words);
    std::fputs("usage: ros2_peer play FOLDER ... | evil TOPIC KIND ... | send TOPIC\n", stderr);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ros2_peer: %s\n", error.what());
    return 1;
  }
}
