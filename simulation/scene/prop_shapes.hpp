#pragma once

#include "simulation/people/person_motion.hpp"
#include "simulation/scene/prop.hpp"
#include "simulation/scene/room.hpp"

namespace stdc {

/// The cardboard box that a person carries, sets down and picks up; it rests in between.
Prop carried_box(const Room& room, const PersonMotion& carrier);
/// The chair that a person pushes.
Prop pushed_chair(const Room& room, const PersonMotion& pusher, const Pose& start);

}  // namespace stdc
