// SQLite recordings, from a file in memory.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "input/recordings/containers/db3_recording.hpp"
#include "input/recordings/containers/unpacked_messages.hpp"
#include "recording_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = memfd_create("fuzz", 0);
  if (file < 0 || write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
  try {
    const auto recording =
        stdc::unpack_messages(stdc::open_db3_recording("/proc/self/fd/" + std::to_string(file), "input"));
    stdc::fuzz::read_through(*recording);
  } catch (const stdc::Error&) {
  }
  close(file);
  return 0;
}
