#pragma once

#include "rendering/person_motion.hpp"
#include "rendering/prop.hpp"
#include "rendering/room.hpp"

namespace stdc {

/// The cardboard box that a person carries, sets down and picks up; it rests in between.
Prop carried_box(const Room& room, const PersonMotion& carrier);
/// The chair that a person pushes.
Prop pushed_chair(const Room& room, const PersonMotion& pusher, const Pose& start);

}  // namespace stdc
