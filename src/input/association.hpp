#pragma once

#include <span>
#include <utility>
#include <vector>

namespace stdc {

/// Pairs two lists of times one to one, the nearest pairs first, none further apart than
/// `max_difference` [s]. Both lists must increase. Among equally near pairs the earlier comes first.
/// Returns indices (into a, into b), increasing in the first. O(n log n).
std::vector<std::pair<int, int>> associate_times(std::span<const double> a, std::span<const double> b,
                                                 double max_difference);

}  // namespace stdc
