// Lists of a video's packets, as ffmpeg writes them.
#include "input/video/video_index.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/error.hpp"
#include "input/video/ffmpeg.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  if (stdc::first_complaint(text, "v.mp4").find('\n') != std::string::npos) std::abort();
  stdc::VideoIndexReader reader;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    reader.add(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  try {
    const stdc::VideoIndex index = reader.result("input");
    if (!index.times.empty() && index.times.size() != static_cast<std::size_t>(index.frames)) std::abort();
    if (std::int64_t{index.size.width} * index.size.height > stdc::kMaxVideoPixels) std::abort();
  } catch (const stdc::Error&) {
  }
  return 0;
}
