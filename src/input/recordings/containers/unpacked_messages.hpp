#pragma once

#include "input/recordings/recording.hpp"

namespace stdc {

/// The same recording with those messages unpacked that rosbag2 has packed one by one (compression mode
/// "message"): a CDR message never begins as zstd data do.
std::unique_ptr<Recording> unpack_messages(std::unique_ptr<Recording> recording);

}  // namespace stdc
