#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace stdc {

/// How soon the next image of a stream may come, learnt from the stamps of the last ones: shorter intervals
/// are rare. (ROS's ApproximateTime has to be told such a bound.)
class UsualInterval {
 public:
  /// Stamps of one stream [ns], increasing.
  void add(std::int64_t stamp);
  /// One interval in ten is shorter, so that a hiccup among the last thirty does not count [ns]; nothing
  /// until ten are known.
  std::optional<std::int64_t> lower_bound() const;

 private:
  std::optional<std::int64_t> last_;
  std::deque<std::int64_t> intervals_;  ///< the last ones [ns]
};

}  // namespace stdc
