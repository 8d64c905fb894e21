#pragma once

#include "simulation/people/balloon_script.hpp"
#include "simulation/scene/prop.hpp"
#include "simulation/scene/room.hpp"
#include "simulation/sequence/camera_path.hpp"

namespace stdc::simulation {

// Objects that move without a body that moves them. World frame, metres, seconds.

/// The board comes from the left at 8.5 s, slides slowly before the desks from 10.5 to 15.3 s, about 1.3 m
/// from the camera of the motion `watch` and over 60 to 80 % of its view, and leaves to the right by 17 s.
Prop sliding_board(const Room& room);
/// The balloon of the script.
Prop floating_balloon(const Room& room, const BalloonScript& script, double seconds);
/// world_from_cupboard: before the desk on the right, its front towards the camera.
Pose cupboard_pose();
/// The door of the cupboard opens twice and closes again. `moves` false: it stays closed.
Prop cupboard_door(const Room& room, bool moves);
/// The trolley rolls in from the left, stops before the desks, rolls on, and comes back without a stop.
Prop rolling_trolley(const Room& room);
/// A dark board comes before the lens from below, 0.2 m away, stays for 2 s, and goes; twice.
Prop lens_cover(const Room& room, const CameraPath& camera);

}  // namespace stdc::simulation
