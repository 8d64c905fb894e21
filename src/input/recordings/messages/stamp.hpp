#pragma once

#include <cstdint>
#include <string>

namespace stdc {

/// Seconds of nanoseconds: exactly the number that a file with these nine decimals would be read as.
double seconds_of(std::int64_t nanoseconds);
/// The nanoseconds of a time with microseconds, as files of text have it: seconds_of() gives the same number
/// back.
std::int64_t stamp_of_seconds(double seconds);
/// "1700000000.033333": with six decimals, as results have it.
std::string stamp_text(std::int64_t nanoseconds);

}  // namespace stdc
