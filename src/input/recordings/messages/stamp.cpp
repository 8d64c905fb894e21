#include "input/recordings/messages/stamp.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace stdc {

double seconds_of(std::int64_t nanoseconds) {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  // By way of the text: dividing rounds twice, as 64 bits of nanoseconds do not fit into a double.
  const std::string text =
      fmt::format("{}{}.{:09}", nanoseconds < 0 ? "-" : "", std::abs(nanoseconds / kNanoseconds),
                  std::abs(nanoseconds % kNanoseconds));
  double seconds = 0;
  std::from_chars(text.data(), text.data() + text.size(), seconds);
  return seconds;
}

std::int64_t stamp_of_seconds(double seconds) { return std::llround(1e6 * seconds) * 1000; }

std::string stamp_text(std::int64_t nanoseconds) { return fmt::format("{:.6f}", seconds_of(nanoseconds)); }

}  // namespace stdc
