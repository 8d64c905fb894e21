#pragma once

#include <opencv2/core/mat.hpp>

#include "motion/static_scene.hpp"

namespace stdc {

/// Whether what is seen in the holes of a frame's depth looks as the static scene there does: where there is
/// no depth, looks alone tell. Holes that the views have as well, such as those of a black screen, tell
/// nothing.
struct HoleLooks {
  cv::Mat compared, changed;  ///< of each cell, CV_8UC1: 1 if a view knows it; if it looks otherwise in one

  /// Sums over the squares of `side` x `side` cells around each cell, CV_32F.
  HoleLooks sums(int side) const;
};

/// What the chosen views say about the holes of a frame that has brightness.
HoleLooks compare_holes(const StaticScene& scene, const GridGeometry& geometry, const SceneFrame& frame);

}  // namespace stdc
