#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of the pose-only optimisation.
struct PoseOptimisationSettings {
  STDC_SETTING(int, rounds, 4, "count", 1, 20,
               "Rounds of optimisation; outliers are classified anew after each");
  STDC_SETTING(int, iterations_per_round, 10, "count", 1, 100,
               "Max iterations of a round; it stops when converged");
  STDC_SETTING(int, min_observations, 3, "count", 3, 100, "Fewer observations than this give no pose");
};

}  // namespace stdc
