#pragma once

#include <cstdint>
#include <vector>

#include "simulation/people/route.hpp"

namespace stdc::simulation {

/// The routes of four people: three walk to and fro between the camera and the desks, each in a lane of their
/// own, one walks behind the desks. They leave the view and come back, and now and then stop and talk.
/// @param seconds  min length of the routes [s]; a longer plan begins with the shorter one
std::vector<Route> plan_crowd(double seconds, std::uint64_t seed);

/// The routes of two people who walk side by side in step across the view, turn together and come back: the
/// same route twice, shifted.
std::vector<Route> plan_side_by_side(double seconds);

}  // namespace stdc::simulation
