// .sens files of ScanNet.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "core/error.hpp"
#include "input/layouts/scannet/sens_index.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream file(std::string(reinterpret_cast<const char*>(data), size));
  try {
    const stdc::SensIndex index = stdc::read_sens_index(file, "input");
    if (index.frames.empty()) std::abort();
    for (const stdc::SensFrame& frame : index.frames) {
      if (frame.colour_at + frame.colour_bytes > size || frame.depth_at + frame.depth_bytes > size)
        std::abort();
    }
    stdc::scannet_cameras(index.calibration, "input");
  } catch (const stdc::Error&) {
  }
  return 0;
}
