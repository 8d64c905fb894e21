#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of the background behind what moves.
struct InpaintingSettings {
  STDC_SETTING(int, margin, 8, "px", 0, 100,
               "So far around what moves the image is replaced too: soft edges, blur, depth shadows");
  STDC_SETTING(int, growth, 60, "px", 0, 1000,
               "So far beyond the mask what touches it is replaced where views have seen through; 0: off");
  STDC_SETTING(int, feather, 5, "px", 0, 100, "Width of the seam, within the margin");
  STDC_SETTING(int, views, 8, "count", 1, 32, "Earlier views that a frame is filled from");
  STDC_SETTING(int, max_views, 64, "count", 2, 4096, "Views kept, about 2.8 MB each at 640x480");
  STDC_SETTING(int, view_interval, 15, "frames", 1, 1000, "A view is kept so often, whatever it shows");
  STDC_SETTING(double, new_share, 0.004, "ratio", 0, 1,
               "A view is also kept if so much of it was not seen from so near before");
  STDC_SETTING(double, depth_tolerance, 0.03, "m", 0.001, 1,
               "Depths that differ by less are the same surface...");
  STDC_SETTING(double, depth_tolerance_growth, 0.012, "1/m", 0, 0.1, "...and by this times z^2 more");
  STDC_SETTING(double, colour_tolerance, 24, "grey levels", 0, 255,
               "Views are averaged where their colours differ by less");
  STDC_SETTING(double, memory, 3, "s", 0.01, 3600,
               "A view this much further away in time has half the vote on what stands where");
  STDC_SETTING(bool, align, true, "Improve the pose of each view against the frame by their brightness");
};

}  // namespace stdc
