// Map files; also with their check sums put right, so that what lies behind them is reached.
#include "atlas/storage/map_file.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>

#include "atlas/storage/record_stream.hpp"
#include "core/error.hpp"

namespace {

/// A map that was read must be one: what it says of others is there, and it can be written.
void read(const std::string& bytes) {
  std::istringstream stream(bytes);
  try {
    const stdc::StoredMap stored = stdc::read_map(stream, "input");
    for (const stdc::LandmarkId id : stored.atlas.landmark_ids()) {
      for (const stdc::Observation& o : stored.atlas.landmark(id).observations) {
        if (stored.atlas.keyframe(o.keyframe).landmarks.at(o.keypoint) != id) std::abort();
      }
    }
    for (const stdc::KeyframeId id : stored.atlas.keyframe_ids()) {
      const stdc::Keyframe& keyframe = stored.atlas.keyframe(id);
      if (keyframe.parent.valid() && !stored.atlas.has(keyframe.parent)) std::abort();
      int seen = 0;
      keyframe.features->for_each_in_window(20, 12, 1e7F, 0, 64, [&](int) { ++seen; });
      if (seen != keyframe.features->size()) std::abort();
    }
    for (const auto& view : stored.views) {
      if (!stored.atlas.has(view->reference)) std::abort();
    }
    std::ostringstream again;
    stdc::write_map(again, stored.camera, stored.atlas, stored.views);
    if (again.str().empty()) std::abort();
  } catch (const stdc::Error&) {
  }
}

std::string with_good_check_sums(std::string bytes) {
  const auto hint = [&](std::size_t at, std::size_t first, std::size_t size) {
    const std::uint32_t sum = stdc::check_sum(bytes.data() + first, size);
    std::memcpy(bytes.data() + at, &sum, sizeof(sum));
  };
  constexpr std::size_t kHead = 16;
  if (bytes.size() < kHead) return bytes;
  std::memcpy(bytes.data(), "STDC-MAP", 8);
  hint(12, 0, 12);
  for (std::size_t at = kHead; at + kHead <= bytes.size();) {
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data() + at + 8, sizeof(size));
    if (size > bytes.size() - at - kHead) break;
    hint(at + 4, at + kHead, size);
    at += kHead + size;
  }
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  read(bytes);
  read(with_good_check_sums(bytes));
  return 0;
}
