// Camera files; what can be read must be written so that it is read again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/error.hpp"
#include "input/camera_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string written;
  try {
    written = stdc::format_camera(
        stdc::parse_camera(std::string(reinterpret_cast<const char*>(data), size), "input"));
  } catch (const stdc::Error&) {
    return 0;
  }
  if (stdc::format_camera(stdc::parse_camera(written, "output")) != written) std::abort();
  return 0;
}
