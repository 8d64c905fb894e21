#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Settings of the dense map.
struct DenseSettings {
  STDC_SETTING(bool, active, false, "Keep depth and colour of the static scene, for a dense map");
  STDC_SETTING(double, voxel, 0.01, "m", 0.002, 1, "Side of a voxel of the distance field");
  STDC_SETTING(double, truncation, 4, "voxels", 2, 16,
               "The field is known this far around surfaces; thinner things may lose a side");
  STDC_SETTING(bool, masks, true, "Leave out what moves; false: to see what that is good for");
  STDC_SETTING(int, margin, 8, "px", 0, 100, "So far around what moves nothing is used");
  STDC_SETTING(double, max_depth, 5, "m", 0.5, 100, "Depths beyond are not used");
  STDC_SETTING(int, window, 15, "frames", 1, 127, "At most so many frames are fused into a view");
  STDC_SETTING(double, window_translation, 0.08, "m", 0.001, 10,
               "A view ends when the camera has moved so far from where it began...");
  STDC_SETTING(double, window_rotation, 6, "deg", 0.1, 90, "...or has turned by so much");
  STDC_SETTING(int, overlap, 5, "views", 1, 1000,
               "A view goes, the oldest first, when more than so many show all that it shows from as near");
  STDC_SETTING(int, min_frames, 3, "frames", 1, 127, "Frames of a view that must agree on a depth");
  STDC_SETTING(int, min_weight, 3, "count", 1, 60000,
               "Weight that a voxel needs, at most 63 of a view, at 1 m; at 3 m a ninth of that");
  STDC_SETTING(double, min_component, 0.01, "m^2", 0, 100, "Smaller pieces of surface are left out");
  STDC_SETTING(double, mesh_tolerance, 0, "m", 0, 1,
               "A mesh is written with fewer triangles, no farther from the whole one than this; 0: whole");
  STDC_SETTING(double, mesh_colour_tolerance, 24, "of 255", 0, 255,
               "...and colours that differ by no more than this in any channel");
  STDC_SETTING(int, mesh_triangles, 0, "count", 0, 100000000,
               "A mesh is written with at most so many triangles, as far as possible; 0: no limit");
  STDC_SETTING(double, cell, 0.05, "m", 0.005, 10, "Side of a cell of the octree and of the plan");
  STDC_SETTING(double, min_obstacle_height, 0.1, "m", 0.01, 10,
               "What is higher above the floor than this, and...");
  STDC_SETTING(double, max_obstacle_height, 1.8, "m", 0.05, 100,
               "...lower than this is an obstacle in the plan");
  STDC_SETTING(int, queue, 8, "frames", 1, 1000,
               "Frames that may wait to be fused beside tracking; then the tracker waits");
};

}  // namespace stdc
