#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of the mask propagation.
struct PropagationSettings {
  STDC_SETTING(int, history, 16, "frames", 2, 100, "Frames kept: how late a mask may arrive");
  STDC_SETTING(double, growth, 0.5, "px", 0, 20,
               "Margin added around a moved mask for each frame of its age");
  STDC_SETTING(double, depth_tolerance, 0.12, "m", 0.01, 2,
               "Max difference between the depth of a pixel and the one predicted for the mask");
  STDC_SETTING(double, depth_growth, 0.03, "m", 0, 1,
               "Added to depth_tolerance for each frame of the mask's age");
};

}  // namespace stdc
