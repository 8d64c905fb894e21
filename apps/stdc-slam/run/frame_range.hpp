#pragma once

#include <optional>
#include <string>

namespace stdc::app {

/// Frames `first` to `end` - 1.
struct FrameRange {
  int first = 0;
  std::optional<int> end = {};  ///< nothing: to the last one, whichever that is
  bool operator==(const FrameRange&) const = default;
};

/// The half-open range of "A:B" within `count` frames, if that is known. Throws Error.
FrameRange parse_frame_range(const std::string& text, std::optional<int> count);

}  // namespace stdc::app
