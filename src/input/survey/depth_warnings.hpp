#pragma once

#include <optional>
#include <string>
#include <vector>

namespace stdc {

/// What the depth images of some frames are like.
struct DepthLook {
  double median = 0, far = 0;  ///< median and 95 % of all depths, in units or metres; 0: there are none
  double valid_share = 0;      ///< of the pixels that have depth
  double saturated_share = 0;  ///< of the pixels that are 65535
};

/// What is likely to be wrong with the depth images, a line each: no depth, little of it, or in another unit
/// than the camera says.
/// @param units_per_metre  of the camera; nothing: not known, or the images are in metres
std::vector<std::string> depth_warnings(const DepthLook& look, std::optional<double> units_per_metre);

}  // namespace stdc
