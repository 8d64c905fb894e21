#pragma once

#include "simulation/people/balloon_script.hpp"
#include "simulation/scene/prop.hpp"
#include "simulation/scene/room.hpp"

namespace stdc::simulation {

// Objects that move without a body that moves them. World frame, metres, seconds.

/// The board comes from the left at 8.5 s, slides slowly before the desks from 10.5 to 15.3 s, about 1.3 m
/// from the camera of the motion `watch` and over 60 to 80 % of its view, and leaves to the right by 17 s.
Prop sliding_board(const Room& room);
/// The balloon of the script.
Prop floating_balloon(const Room& room, const BalloonScript& script, double seconds);

}  // namespace stdc::simulation
