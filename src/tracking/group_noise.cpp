#include "tracking/group_noise.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace stdc {
namespace {

constexpr double kSpan = 3;  // [s] longer than what begins to move takes to be found

}  // namespace

void GroupNoise::add(double timestamp, double shift) {
  if (!entries_.empty() && entries_.back().timestamp >= timestamp) {
    entries_.back().shift = shift;
    return;
  }
  before_ = std::move(now_);
  now_.clear();
  entries_.push_back({timestamp, shift});
  while (entries_.front().timestamp < timestamp - kSpan) entries_.pop_front();
}

double GroupNoise::threshold(double timestamp) const {
  constexpr double kKnown = 0.5;  // [s]
  constexpr double kFactor = 6, kMin = 0.4, kMax = 1;
  if (entries_.empty() || timestamp - entries_.front().timestamp < kKnown)
    return std::numeric_limits<double>::infinity();
  std::vector<double> shifts;
  for (const Entry& entry : entries_) shifts.push_back(entry.shift);
  const auto middle = shifts.begin() + static_cast<std::ptrdiff_t>(shifts.size() / 2);
  std::nth_element(shifts.begin(), middle, shifts.end());
  const double threshold = std::max({kMin, kFactor * *middle, 2 * entries_.back().shift});
  return threshold < kMax ? threshold : std::numeric_limits<double>::infinity();
}

void GroupNoise::clear() {
  entries_.clear();
  before_.clear();
  now_.clear();
}

}  // namespace stdc
