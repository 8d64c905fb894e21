#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace stdc {

/// An edge that may be collapsed. It is out of date when one of its vertices has changed since.
struct CollapseCandidate {
  double cost;
  std::uint32_t a, b;
  std::uint32_t changes;
  bool operator<(const CollapseCandidate& other) const {  // the cheapest comes first; no two are equal
    if (cost != other.cost) return cost > other.cost;
    return a != other.a ? a > other.a : b > other.b;
  }
};

/// Candidates, of which the cheapest comes next. Each collapse changes the cost of the edges around it, which
/// are queued again; what is out of date is thrown out when there is no room left, in place of getting more.
class CollapseQueue {
 public:
  void reserve(std::size_t candidates) { heap_.reserve(candidates); }
  bool empty() const { return heap_.empty(); }
  std::size_t size() const { return heap_.size(); }

  /// @param counts  whether a candidate is not out of date
  template <typename Counts>
  void push(const CollapseCandidate& candidate, const Counts& counts) {
    if (heap_.size() == heap_.capacity()) {
      std::erase_if(heap_, [&](const CollapseCandidate& old) { return !counts(old); });
      std::make_heap(heap_.begin(), heap_.end());
      if (heap_.size() > heap_.capacity() / 16 * 15) heap_.reserve(2 * heap_.capacity() + 16);
    }
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
  }
  CollapseCandidate pop() {
    std::pop_heap(heap_.begin(), heap_.end());
    const CollapseCandidate next = heap_.back();
    heap_.pop_back();
    return next;
  }

 private:
  std::vector<CollapseCandidate> heap_;
};

}  // namespace stdc
