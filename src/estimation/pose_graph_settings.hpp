#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of the pose-graph optimisation.
struct PoseGraphSettings {
  STDC_SETTING(int, iterations, 30, "count", 1, 1000, "Max iterations of the pose-graph optimisation");
  STDC_SETTING(double, min_relative_decrease, 1e-6, "ratio", 0, 0.1,
               "It ends when the cost falls by less than this share");
  STDC_SETTING(double, robust_chi_square, 12.592, "", 0.01, 1e6,
               "Squared error of a robust edge beyond which it counts less (95 % quantile: 12.592)");
};

}  // namespace stdc
