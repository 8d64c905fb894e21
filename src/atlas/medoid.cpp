#include "atlas/medoid.hpp"

#include <algorithm>
#include <vector>

#include "core/multiversion.hpp"
#include "features/description/hamming.hpp"

namespace stdc {
namespace {

STDC_POPCNT_VERSIONS
void measure_all(const Descriptor* const* descriptors, int count, int* distances) {
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      distances[i * count + j] = distances[j * count + i] =
          hamming_distance(*descriptors[i], *descriptors[j]);
    }
  }
}

}  // namespace

int medoid(std::span<const Descriptor* const> descriptors) {
  const auto count = static_cast<int>(descriptors.size());
  if (count <= 2) return 0;
  std::vector<int> distances(static_cast<std::size_t>(count) * count, 0);
  measure_all(descriptors.data(), count, distances.data());
  int best = 0, min_median = 257;
  for (int i = 0; i < count; ++i) {
    const auto row = distances.begin() + i * count;
    std::nth_element(row, row + count / 2, row + count);
    if (row[count / 2] < min_median) {
      min_median = row[count / 2];
      best = i;
    }
  }
  return best;
}

}  // namespace stdc
