#include "input/recordings/usual_interval.hpp"

#include <algorithm>
#include <vector>

namespace stdc {
namespace {

constexpr std::size_t kIntervalsKept = 30, kIntervalsNeeded = 10;
constexpr std::size_t kShorterOnes = 10;  // one in so many

}  // namespace

void UsualInterval::add(std::int64_t stamp) {
  if (last_) intervals_.push_back(stamp - *last_);
  if (intervals_.size() > kIntervalsKept) intervals_.pop_front();
  last_ = stamp;
}

std::optional<std::int64_t> UsualInterval::lower_bound() const {
  if (intervals_.size() < kIntervalsNeeded) return std::nullopt;
  std::vector<std::int64_t> sorted(intervals_.begin(), intervals_.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted[(sorted.size() - 1) / kShorterOnes];
}

}  // namespace stdc
