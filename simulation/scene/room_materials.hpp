#pragma once

#include <cstdint>

#include "simulation/scene/printed_textures.hpp"
#include "simulation/scene/shapes.hpp"
#include "simulation/scene/world.hpp"

namespace stdc::simulation {

/// Pictures of one kind in one bitmap, as finishes.
struct PictureSet {
  int material = 0;
  PictureSheet layout;  ///< only its counts and the bitmap's size are used

  Finish pick(std::uint32_t index) const { return {material, layout.area(static_cast<int>(index))}; }
};

/// The finishes that furniture and clutter are made of.
struct RoomMaterials {
  Finish floor, rug, wall, brick, wainscot, ceiling, light_panel, window, door;
  Finish desk_wood, shelf_wood, black_plastic, grey_plastic, white_plastic, screen_frame, metal, paper_edge;
  Finish chair_cloth, curtain, cardboard, leaf, clay, soil, cork, whiteboard, calendar, clock, keyboard,
      cable;
  Finish white_glaze, blue_glaze, red_glaze, glass, yellow_paint, red_paint, green_paint, blue_paint;
  PictureSet spines, covers, pages, packages, screens, posters, notes;
};

/// Paints all textures and adds them and their materials to `world`. The seed also chooses the colours.
RoomMaterials add_room_materials(World& world, std::uint64_t seed);

}  // namespace stdc::simulation
