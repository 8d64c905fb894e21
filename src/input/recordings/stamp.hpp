#pragma once

#include <cstdint>
#include <string>

namespace stdc {

/// Seconds of nanoseconds: exactly the number that a file with these nine decimals would be read as.
double seconds_of(std::int64_t nanoseconds);
/// "1700000000.033333": with six decimals, as results have it.
std::string stamp_text(std::int64_t nanoseconds);

}  // namespace stdc
