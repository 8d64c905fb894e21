#pragma once

#include "simulation/scene/room.hpp"

namespace stdc::simulation {

// Objects that only some presets have; they move, or stand in the room without being part of it. Each is a
// mesh in the object's own frame, metres, z up, its front along -y, with the materials of `room`.

constexpr double kBoardWidth = 1.13, kBoardHeight = 1.6;
constexpr double kBalloonRadius = 0.16;
constexpr double kSideTableHeight = 0.73;
constexpr double kCupboardWidth = 0.9, kCupboardDepth = 0.42, kCupboardHeight = 1.95;
constexpr double kCoverWidth = 0.52, kCoverHeight = 0.42;

/// A board full of prints; the origin is the middle of its lower edge.
Mesh board_mesh(const Room& room);
/// A plain balloon, a little longer than wide; the origin is its centre.
Mesh balloon_mesh(const Room& room);
/// A small table, 0.6 x 0.45 m, as high as the desks.
Mesh side_table_mesh(const Room& room);
/// A cupboard full of books, open in front.
Mesh cupboard_mesh(const Room& room);
/// Its door when closed; the origin is the lower end of the hinge, on the left, and the door lies along +x.
Mesh cupboard_door_mesh(const Room& room);
/// A trolley with boxes, 0.8 m long along x.
Mesh trolley_mesh(const Room& room);
/// A dark board; the origin is its centre.
Mesh lens_cover_mesh(const Room& room);

}  // namespace stdc::simulation
