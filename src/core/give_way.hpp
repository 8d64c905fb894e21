#pragma once

#include <sys/resource.h>

namespace stdc {

/// The calling thread gives way to others, as Linux has it: threads have priorities of their own, and those
/// it starts inherit its. If it fails, it does not.
inline void give_way() {
  constexpr int kGiveWay = 10;
  setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + kGiveWay);
}

}  // namespace stdc
