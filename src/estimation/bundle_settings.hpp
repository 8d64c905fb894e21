#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of the bundle adjustment.
struct BundleSettings {
  STDC_SETTING(int, robust_iterations, 5, "count", 1, 100,
               "Max iterations of the first stage, all observations, Huber kernel");
  STDC_SETTING(int, final_iterations, 5, "count", 0, 100,
               "Max iterations of the second stage, without outliers");
  STDC_SETTING(double, min_relative_decrease, 1e-4, "ratio", 0, 0.1,
               "A stage ends when the cost falls by less than this share");
  STDC_SETTING(double, loss_width, 4, "ratio", 0, 100,
               "Cauchy weights in the second stage, of this width in multiples of the noise that the first "
               "leaves, wider towards the bend of Huber's kernel; 0: that alone");
};

}  // namespace stdc
