// MCAP files.
#include <cstddef>
#include <cstdint>

#include "input/recordings/containers/mcap_recording.hpp"
#include "recording_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    stdc::McapRecording recording(stdc::bytes_in_memory({data, data + size}), "input");
    stdc::fuzz::read_through(recording);
  } catch (const stdc::Error&) {
  }
  return 0;
}
