#pragma once

#include <cstring>
#include <string>

namespace stdc::test {

/// A number in a message; 0 beyond its end.
template <typename Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number value{};
  if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

}  // namespace stdc::test
