#pragma once

#include "simulation/scene/room.hpp"

namespace stdc::simulation {

// Objects that only some presets have; they move, or stand in the room without being part of it. Each is a
// mesh in the object's own frame, metres, z up, its front along -y, with the materials of `room`.

constexpr double kBoardWidth = 1.25, kBoardHeight = 1.6;
constexpr double kBalloonRadius = 0.16;
constexpr double kSideTableHeight = 0.73;

/// A board full of prints; the origin is the middle of its lower edge.
Mesh board_mesh(const Room& room);
/// A plain balloon, a little longer than wide; the origin is its centre.
Mesh balloon_mesh(const Room& room);
/// A small table, 0.6 x 0.45 m, as high as the desks.
Mesh side_table_mesh(const Room& room);

}  // namespace stdc::simulation
