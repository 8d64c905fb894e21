#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

namespace stdc::test {

/// Runs `check` once with each of the instruction sets that this processor has, from the plainest on.
template <typename Check>
void on_every_target(Check&& check) {
  std::int64_t left = hwy::SupportedTargets();
  ASSERT_NE(left, 0);
  for (; left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    check();
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace stdc::test
