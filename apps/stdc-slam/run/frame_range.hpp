#pragma once

#include <string>
#include <utility>

namespace stdc::app {

/// The half-open range of "A:B" within `count` frames. Throws Error.
std::pair<int, int> parse_frame_range(const std::string& text, int count);

}  // namespace stdc::app
