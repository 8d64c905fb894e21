#pragma once

#include <cstdint>

#include "simulation/scene/room_materials.hpp"
#include "simulation/scene/world.hpp"

namespace stdc {

/// Where things stand in the room, for those who move through it. Metres; x east, y north, floor at z = 0.
struct RoomPlan {
  static constexpr double kHalfWidth = 3.8, kHalfDepth = 3.2, kHeight = 2.7;
  /// The island of four desks in the middle: x in [-kIslandX, kIslandX], y in [kIslandSouth, kIslandNorth].
  static constexpr double kIslandX = 1.4, kIslandSouth = 0.2, kIslandNorth = 1.8;
};

struct Room {
  World world;
  RoomMaterials materials;
};

/// Builds the office that all presets take place in: an island of desks, shelves, posters, a window and
/// plants.
/// @param seed        textures, colours and where the clutter lies
/// @param with_chair  whether the chair before the desks that people use (or push) is part of the static room
Room make_room(std::uint64_t seed, bool with_chair);

/// Where that chair stands: world_from_chair.
Pose visitor_chair_pose();

}  // namespace stdc
