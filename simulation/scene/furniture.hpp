#pragma once

#include "core/random.hpp"
#include "simulation/scene/room_materials.hpp"
#include "simulation/scene/shapes.hpp"

namespace stdc::simulation {

// Furniture, each piece built around the origin of the builder's frame: it stands on z = 0 and its front
// faces -y. Metres.

constexpr double kDeskHeight = 0.73;
constexpr double kSeatHeight = 0.47;

void add_desk(ShapeBuilder& b, const RoomMaterials& m, double width, double depth);
/// Office chair on a five-star base, 0.6 m across; the sitter faces -y.
void add_office_chair(ShapeBuilder& b, const RoomMaterials& m);
/// Shelf with boards every ~0.35 m, filled with books and boxes.
void add_bookshelf(ShapeBuilder& b, const RoomMaterials& m, double width, double height, Random& random);
/// A row of books standing on z = 0 from x = 0 to about `width`, spines at y = 0, not higher than `height`.
void add_book_row(ShapeBuilder& b, const RoomMaterials& m, double width, double height, double depth,
                  Random& random);
/// Filing cabinet with drawers.
void add_cabinet(ShapeBuilder& b, const RoomMaterials& m, double width, double height, int drawers);
/// Screen on a foot; `picture` chooses what it shows, < 0: switched off.
void add_monitor(ShapeBuilder& b, const RoomMaterials& m, double width, int picture);
/// Pot with a plant about `height` high.
void add_plant(ShapeBuilder& b, const RoomMaterials& m, double height, Random& random);
/// Stand with a coat and a bag.
void add_coat_stand(ShapeBuilder& b, const RoomMaterials& m, Random& random);
/// Round waste bin.
void add_bin(ShapeBuilder& b, const RoomMaterials& m);
/// Ribbed radiator below a window, against y = 0.
void add_radiator(ShapeBuilder& b, const RoomMaterials& m, double width);
void add_floor_lamp(ShapeBuilder& b, const RoomMaterials& m);

}  // namespace stdc::simulation
