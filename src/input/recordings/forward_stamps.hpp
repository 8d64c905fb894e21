#pragma once

#include <cstdint>
#include <optional>

namespace stdc {

/// Lets through what comes later than the last of its topic, and counts what does not.
class ForwardStamps {
 public:
  bool passes(std::int64_t stamp) {
    if (last_ && stamp <= *last_) {
      ++left_out_;
      return false;
    }
    last_ = stamp;
    return true;
  }
  int left_out() const { return left_out_; }

 private:
  std::optional<std::int64_t> last_;
  int left_out_ = 0;
};

}  // namespace stdc
