// ROS 1 bags.
#include <cstddef>
#include <cstdint>

#include "input/recordings/containers/bag_recording.hpp"
#include "recording_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    stdc::BagRecording recording(stdc::bytes_in_memory({data, data + size}), "input");
    stdc::fuzz::read_through(recording);
  } catch (const stdc::Error&) {
  }
  return 0;
}
