#pragma once

#include <span>

#include "features/keypoint.hpp"

namespace stdc {

/// Index of the descriptor whose median distance to all is least, the first of equals (Mur-Artal, Montiel and
/// Tardos, 'ORB-SLAM', T-RO 2015, sec. III-C); 0 if there are fewer than three.
int medoid(std::span<const Descriptor* const> descriptors);

}  // namespace stdc
