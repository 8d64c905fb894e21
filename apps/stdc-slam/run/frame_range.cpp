#include "run/frame_range.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <string_view>

#include "core/error.hpp"

namespace stdc::app {
namespace {

/// A whole number, or `missing` where there is no text; nothing if it is something else.
std::optional<int> parse_index(std::string_view text, int missing) {
  if (text.empty()) return missing;
  int value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

}  // namespace

FrameRange parse_frame_range(const std::string& text, std::optional<int> count) {
  if (text.empty()) return {0, count};
  constexpr int kToTheLast = std::numeric_limits<int>::max();
  const std::size_t colon = text.find(':');
  const auto first = parse_index(std::string_view(text).substr(0, colon), 0);
  const auto end = colon == std::string::npos
                       ? std::nullopt
                       : parse_index(std::string_view(text).substr(colon + 1), count.value_or(kToTheLast));
  if (!first || !end) {
    throw Error("--frames", fmt::format("'{}' is not of the form A:B", text),
                "give the first frame and the one after the last, counted from 0, for instance 0:300");
  }
  if (count && (*first >= *end || *end > *count)) {
    throw Error(
        "--frames",
        fmt::format("{}:{} is empty or goes beyond the {} frames of the sequence", *first, *end, *count),
        fmt::format("give a range within 0:{}", *count));
  }
  if (*first >= *end) {
    throw Error("--frames", fmt::format("{} is empty", text),
                "give the frame after the last as the second number");
  }
  return {*first, *end == kToTheLast ? std::nullopt : end};
}

}  // namespace stdc::app
