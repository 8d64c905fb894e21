#pragma once

#include <cstdint>

#include "simulation/people/route.hpp"

namespace stdc::simulation {

/// One person carries a box to the desks, puts it down, pushes a chair, picks the box up, and begins again.
struct BoxScript {
  Route route;
  Pose chair_start;  ///< world_from_chair before it is pushed
};

/// @param seconds  min length of the route [s]
BoxScript plan_box_carrier(double seconds, std::uint64_t seed);

}  // namespace stdc::simulation
