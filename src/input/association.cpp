#include "input/association.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>

namespace stdc {
namespace {

struct Stamp {
  double time;
  int list;   // 0: a, 1: b
  int index;  // within its list
};

std::vector<Stamp> merged(std::span<const double> a, std::span<const double> b) {
  std::vector<Stamp> stamps;
  stamps.reserve(a.size() + b.size());
  for (std::size_t i = 0; i < a.size(); ++i) stamps.push_back({a[i], 0, static_cast<int>(i)});
  for (std::size_t i = 0; i < b.size(); ++i) stamps.push_back({b[i], 1, static_cast<int>(i)});
  const auto middle = stamps.begin() + static_cast<std::ptrdiff_t>(a.size());
  std::inplace_merge(stamps.begin(), middle, stamps.end(),
                     [](const Stamp& s, const Stamp& t) { return s.time < t.time; });
  return stamps;
}

}  // namespace

// The nearest pair of what is left always stands side by side on the time line, so it is enough to know the
// neighbours: a doubly linked list of stamps and a queue of neighbouring pairs, of which those whose stamps
// are gone or no longer neighbours are passed over when they come up.
std::vector<std::pair<int, int>> associate_times(std::span<const double> a, std::span<const double> b,
                                                 double max_difference) {
  const std::vector<Stamp> stamps = merged(a, b);
  const int count = static_cast<int>(stamps.size());
  std::vector<int> before(stamps.size()), after(stamps.size());
  for (int i = 0; i < count; ++i) {
    before[i] = i - 1;
    after[i] = i + 1;
  }
  using Gap = std::tuple<double, int, int>;  // difference, left, right
  std::priority_queue<Gap, std::vector<Gap>, std::greater<>> gaps;
  const auto push = [&](int left, int right) {
    if (left < 0 || right >= count || stamps[left].list == stamps[right].list) return;
    const double difference = stamps[right].time - stamps[left].time;
    if (difference <= max_difference) gaps.emplace(difference, left, right);
  };
  for (int i = 0; i + 1 < count; ++i) push(i, i + 1);

  std::vector<bool> gone(stamps.size(), false);
  std::vector<std::pair<int, int>> pairs;
  while (!gaps.empty()) {
    const auto [difference, left, right] = gaps.top();
    gaps.pop();
    if (gone[left] || gone[right]) continue;
    gone[left] = gone[right] = true;
    const int a_stamp = stamps[left].list == 0 ? left : right;
    const int b_stamp = stamps[left].list == 0 ? right : left;
    pairs.emplace_back(stamps[a_stamp].index, stamps[b_stamp].index);
    const int previous = before[left], next = after[right];
    if (previous >= 0) after[previous] = next;
    if (next < count) before[next] = previous;
    push(previous, next);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace stdc
