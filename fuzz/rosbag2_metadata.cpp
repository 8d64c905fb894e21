// metadata.yaml of rosbag2.
#include "input/recordings/containers/rosbag2_metadata.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto metadata = stdc::parse_rosbag2_metadata({reinterpret_cast<const char*>(data), size}, "input");
    if (metadata.files.empty()) std::abort();
  } catch (const stdc::Error&) {
  }
  return 0;
}
