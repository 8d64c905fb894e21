#pragma once

#include <cstdint>
#include <vector>

#include "simulation/people/route.hpp"

namespace stdc::simulation {

/// The routes of two people who walk round the desks, stop, talk, sit down and get up again, mostly in front
/// of the camera, never nearer to each other than 0.6 m and clear of the furniture. A longer plan begins with
/// the shorter one.
/// @param seconds  min length of the routes [s]
std::vector<Route> plan_walks(double seconds, std::uint64_t seed);

}  // namespace stdc::simulation
