// Settings files; what can be read must be written so that it is read again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/error.hpp"
#include "slam/settings_io.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  stdc::Settings settings;
  try {
    stdc::parse_settings(std::string(reinterpret_cast<const char*>(data), size), "input", settings);
    settings.validate();
  } catch (const stdc::Error&) {
    return 0;
  }
  const std::string written = stdc::format_settings(settings);
  stdc::Settings again;
  stdc::parse_settings(written, "output", again);
  if (stdc::format_settings(again) != written) std::abort();
  return 0;
}
