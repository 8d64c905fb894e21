// metadata.json of Record3D.
#include "input/layouts/record3d_metadata.hpp"

#include <cstddef>
#include <cstdint>

#include "core/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    stdc::parse_record3d_metadata(std::string(reinterpret_cast<const char*>(data), size), "input");
  } catch (const stdc::Error&) {
  }
  return 0;
}
