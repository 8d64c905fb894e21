#pragma once

#include <cstdint>

#include "simulation/scene/room_materials.hpp"
#include "simulation/scene/room_plan.hpp"
#include "simulation/scene/world.hpp"

namespace stdc::simulation {

struct Room {
  World world;
  RoomMaterials materials;
};

/// Builds the office that all presets take place in: an island of desks, shelves, posters, a window and
/// plants.
/// @param seed        textures, colours and the places of the clutter
/// @param with_chair  whether the visitors' chair before the desks is part of the static room
Room make_room(std::uint64_t seed, bool with_chair);

/// Where that chair stands: world_from_chair.
Pose visitor_chair_pose();

}  // namespace stdc::simulation
