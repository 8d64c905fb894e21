// The cupboard of loose_objects.hpp and its door.
#include "core/random.hpp"
#include "simulation/scene/furniture.hpp"
#include "simulation/scene/loose_objects.hpp"

namespace stdc::simulation {
namespace {

constexpr double kWall = 0.02, kFoot = 0.06;

}  // namespace

Mesh cupboard_mesh(const Room& room) {
  const RoomMaterials& m = room.materials;
  Mesh mesh;
  ShapeBuilder b(mesh, room.world.materials, 10);
  const double inner = kCupboardWidth - 2 * kWall, depth = kCupboardDepth;
  for (const double side : {-1.0, 1.0})
    b.box({side * (kCupboardWidth - kWall) / 2, 0, 0}, {kWall, depth, kCupboardHeight}, m.shelf_wood);
  b.box({0, (depth - kWall) / 2, 0}, {inner, kWall, kCupboardHeight}, m.shelf_wood);
  b.box({0, 0, kCupboardHeight - kWall}, {inner, depth - kWall, kWall}, m.shelf_wood);
  b.box({0, -0.01, 0}, {inner, depth - 0.06, kFoot}, m.shelf_wood);
  Random random(10, 14);
  constexpr int kShelves = 5;
  constexpr double kStep = (kCupboardHeight - kFoot - kWall) / kShelves;
  for (int i = 0; i < kShelves; ++i) {
    const double z = kFoot + i * kStep;
    if (i > 0) b.box({0, 0.02, z - kWall}, {inner, depth - 0.1, kWall}, m.shelf_wood);
    b.world_from_local = placed(-inner / 2 + 0.02, -0.12, z);
    add_book_row(b, m, i % 2 == 0 ? 0.8 : 0.5, kStep - 0.06, 0.2, random);
    b.world_from_local = Pose();
    if (i % 2 == 1) b.box({0.26, 0, z}, {0.24, 0.2, 0.2}, m.packages.pick(random.next()));
  }
  return mesh;
}

Mesh cupboard_door_mesh(const Room& room) {
  const RoomMaterials& m = room.materials;
  Mesh mesh;
  ShapeBuilder b(mesh, room.world.materials, 11);
  constexpr double kWidth = kCupboardWidth - 0.01, kHeight = kCupboardHeight - kFoot;
  b.box({kWidth / 2, -kWall / 2, kFoot}, {kWidth, kWall, kHeight}, m.door);
  const auto print = [&](const Finish& finish, double x, double z, double width, double height) {
    b.rectangle({x, -kWall - 0.001, z}, {width, 0, 0}, {0, 0, height}, finish);
  };
  print(m.posters.pick(6), 0.14, 0.95, 0.52, 0.72);
  print(m.calendar, 0.2, 0.35, 0.25, 0.5);
  print(m.notes.pick(5), 0.52, 0.6, 0.12, 0.12);
  print(m.pages.pick(2), 0.5, 0.3, 0.2, 0.28);
  b.rod({{kWidth - 0.05, -kWall, 0.98},
         {kWidth - 0.05, -0.06, 1.0},
         {kWidth - 0.05, -0.06, 1.14},
         {kWidth - 0.05, -kWall, 1.16}},
        0.008, m.metal);
  // The inner side, seen while it is open.
  b.rectangle({0.7, 0.001, 0.8}, {-0.5, 0, 0}, {0, 0, 0.7}, m.posters.pick(3));
  return mesh;
}

}  // namespace stdc::simulation
