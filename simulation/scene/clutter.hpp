#pragma once

#include "core/random.hpp"
#include "simulation/scene/room_materials.hpp"
#include "simulation/scene/shapes.hpp"

namespace stdc::simulation {

// Small objects, each standing on z = 0 at the origin of the builder's frame, front along -y.

void add_mug(ShapeBuilder& b, const RoomMaterials& m, Random& random);
void add_bottle(ShapeBuilder& b, const RoomMaterials& m, Random& random);
void add_tin(ShapeBuilder& b, const RoomMaterials& m, Random& random);
void add_carton(ShapeBuilder& b, const RoomMaterials& m, Random& random);
void add_book_pile(ShapeBuilder& b, const RoomMaterials& m, int books, Random& random);
/// Sheets of paper strewn over a rectangle of width x depth.
void add_papers(ShapeBuilder& b, const RoomMaterials& m, int sheets, double width, double depth,
                Random& random);
void add_pen_holder(ShapeBuilder& b, const RoomMaterials& m, Random& random);
void add_keyboard(ShapeBuilder& b, const RoomMaterials& m);
void add_mouse(ShapeBuilder& b, const RoomMaterials& m);
void add_telephone(ShapeBuilder& b, const RoomMaterials& m);
void add_desk_lamp(ShapeBuilder& b, const RoomMaterials& m);
void add_laptop(ShapeBuilder& b, const RoomMaterials& m, int picture);
/// A winding cable on the plane z = 0 between two points.
void add_cable(ShapeBuilder& b, const RoomMaterials& m, const Eigen::Vector2d& from,
               const Eigen::Vector2d& to, Random& random);
void add_fruit_bowl(ShapeBuilder& b, const RoomMaterials& m);
/// Objects of all kinds on a rectangle of width x depth, not touching each other.
void scatter(ShapeBuilder& b, const RoomMaterials& m, int count, double width, double depth, Random& random);

}  // namespace stdc::simulation
