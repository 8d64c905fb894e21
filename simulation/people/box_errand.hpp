#pragma once

#include "simulation/people/route.hpp"

namespace stdc::simulation {

/// What a person does with the box on the side table, once: brings it, takes it away by the way it came, or
/// carries it off across the whole view.
enum class BoxErrand { place, remove, kidnap };

/// world_from_table of the table that the box stands on.
Pose side_table_pose();

/// The person comes from outside of the view, handles the box and leaves the view; before and after, only the
/// box is seen, or nothing.
Route plan_box_errand(BoxErrand errand);

}  // namespace stdc::simulation
