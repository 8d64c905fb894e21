#pragma once

#include <cstdint>
#include <vector>

#include "rendering/route.hpp"

namespace stdc {

/// The ways of two people who walk about the desks, stop, talk, sit down and get up again, mostly before the
/// camera, and never come nearer to each other than 0.6 m or to furniture than they should. A longer plan
/// begins with the shorter one.
/// @param seconds  the least time that is planned
std::vector<Route> direct_walkers(double seconds, std::uint64_t seed);

/// The way of one person who carries a box to the desks, sets it down, pushes the chair, and begins again.
struct BoxPlay {
  Route route;
  Pose chair_start;
};
BoxPlay direct_box_carrier(double seconds, std::uint64_t seed);

}  // namespace stdc
