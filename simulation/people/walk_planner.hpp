#pragma once

#include <cstdint>
#include <vector>

#include "simulation/people/route.hpp"

namespace stdc {

/// The ways of two people who walk about the desks, stop, talk, sit down and get up again, mostly before the
/// camera, and never come nearer to each other than 0.6 m or to furniture than they should. A longer plan
/// begins with the shorter one.
/// @param seconds  the least time that is planned
std::vector<Route> plan_walks(double seconds, std::uint64_t seed);

/// The way of one person who carries a box to the desks, sets it down, pushes the chair, and begins again.
struct BoxScript {
  Route route;
  Pose chair_start;
};
BoxScript plan_box_carrier(double seconds, std::uint64_t seed);

}  // namespace stdc
