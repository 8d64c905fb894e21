// Camera files; what can be read must be written so that it is read again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/error.hpp"
#include "input/camera_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string written;
  try {
    written = stdc::format_cameras(
        stdc::parse_cameras(std::string(reinterpret_cast<const char*>(data), size), "input"));
  } catch (const stdc::Error&) {
    return 0;
  }
  stdc::RgbdCameras again = stdc::parse_cameras(written, "output");
  // A rotation is normalised when it is read, which may change its last digit.
  const std::string text = stdc::format_cameras(again);
  if (text != written && stdc::format_cameras(stdc::parse_cameras(text, "again")) != text) std::abort();
  return 0;
}
