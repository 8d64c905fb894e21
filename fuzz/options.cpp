// --set section.key=value and --frames A:B.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/error.hpp"
#include "run/frame_range.hpp"
#include "slam/settings_io.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    stdc::Settings settings;
    stdc::apply_setting(text, settings);
    settings.validate();
  } catch (const stdc::Error&) {
  }
  try {
    const auto [first, end] = stdc::app::parse_frame_range(text, 1000);
    if (first < 0 || !end || first >= *end || *end > 1000) std::abort();
    stdc::app::parse_frame_range(text, {});
  } catch (const stdc::Error&) {
  }
  return 0;
}
