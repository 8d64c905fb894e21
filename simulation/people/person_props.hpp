#pragma once

#include "simulation/people/person_motion.hpp"
#include "simulation/scene/prop.hpp"
#include "simulation/scene/room.hpp"

namespace stdc::simulation {

/// The cardboard box that a person carries, puts down and picks up; at rest in between, and before the first
/// move. The person's route must have an episode with the box.
Prop carried_box(const Room& room, const PersonMotion& carrier);
/// The chair that a person pushes.
Prop pushed_chair(const Room& room, const PersonMotion& pusher, const Pose& start);

}  // namespace stdc::simulation
