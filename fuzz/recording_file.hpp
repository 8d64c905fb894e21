#pragma once

#include <cstdlib>
#include <memory>
#include <numeric>
#include <vector>

#include "core/error.hpp"
#include "input/recordings/recording.hpp"

namespace stdc::fuzz {

/// Reads all of a recording, twice: what a topic or a message says must be there.
inline void read_through(Recording& recording) {
  std::vector<int> topics(recording.topics().size());
  std::iota(topics.begin(), topics.end(), 0);
  int counts[2] = {0, 0};
  for (int& count : counts) {
    recording.start(topics);
    unsigned sum = 0;
    while (const auto message = recording.next()) {
      if (message->topic < 0 || message->topic >= static_cast<int>(topics.size())) std::abort();
      for (const std::uint8_t byte : message->data) sum += byte;  // AddressSanitizer sees what is not there
      ++count;
    }
    if (sum == 0xFFFFFFFF) std::abort();
  }
  if (counts[0] != counts[1]) std::abort();
  recording.faults();
}

}  // namespace stdc::fuzz
