#pragma once

#include "core/random.hpp"
#include "simulation/scene/room_materials.hpp"
#include "simulation/scene/shapes.hpp"

namespace stdc::simulation {

/// The four desks in the middle of the room (see RoomPlan) with the clutter on them, their chairs and the
/// rug.
void add_island(ShapeBuilder& b, const RoomMaterials& m, Random& random);

}  // namespace stdc::simulation
