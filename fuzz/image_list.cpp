// Image lists, and pairing the times of two of them: the input is split at the first 'Z'.
#include "core/files/image_list.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string_view>

#include "core/error.hpp"
#include "input/association.hpp"

namespace {

std::vector<double> times_of(std::string_view text) {
  std::vector<double> times;
  for (const auto& entry : stdc::parse_image_list(text, "input")) times.push_back(entry.timestamp);
  return times;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t middle = text.find('Z');
  try {
    const auto first = times_of(text.substr(0, middle));
    if (middle == std::string_view::npos) return 0;
    const auto second = times_of(text.substr(middle + 1));
    std::set<int> used;
    for (const auto& [a, b] : stdc::associate_times(first, second, 0.02)) {
      if (!used.insert(b).second) std::abort();  // one to one
    }
  } catch (const stdc::Error&) {
  }
  return 0;
}
