#include "simulation/scene/loose_objects.hpp"

#include "core/random.hpp"

namespace stdc::simulation {

using Eigen::Vector3d;

Mesh board_mesh(const Room& room) {
  const RoomMaterials& m = room.materials;
  Mesh mesh;
  ShapeBuilder b(mesh, room.world.materials, 7);
  constexpr double kThickness = 0.02, kPaper = 0.0015;
  b.box({0, 0, 0}, {kBoardWidth, kThickness, kBoardHeight},
        BoxFinish{m.cork, m.shelf_wood, m.shelf_wood, m.shelf_wood, m.shelf_wood, m.shelf_wood});
  const auto pin = [&](const Finish& print, double x, double z, double width, double height, int layer) {
    b.rectangle({x - width / 2, -kThickness / 2 - kPaper * layer, z - height / 2}, {width, 0, 0},
                {0, 0, height}, print);
  };
  for (int i = 0; i < 4; ++i) {
    const int column = i % 2, row = i / 2;
    pin(m.posters.pick(i + 1), (column - 0.5) * 0.62, kBoardHeight / 2 + (row - 0.5) * 0.78, 0.5, 0.68, 1);
  }
  Random random(7, 13);
  constexpr int kColumns = 7, kRows = 5;
  for (int i = 0; i < kColumns * kRows; ++i) {  // notes and pages, some over the edges of the posters
    const int column = i % kColumns, row = i / kColumns;
    const double x = ((column + 0.5) / kColumns - 0.5) * (kBoardWidth - 0.1) + random.uniform(-0.04, 0.04),
                 z = (row + 0.5) / kRows * (kBoardHeight - 0.1) + 0.05 + random.uniform(-0.06, 0.06);
    const double size = random.uniform(0.07, 0.13);
    const Finish print = random.below(2) == 0 ? m.pages.pick(random.next()) : m.notes.pick(random.next());
    if (random.below(3) != 0) pin(print, x, z, size, 1.2 * size, 2);
  }
  return mesh;
}

Mesh balloon_mesh(const Room& room) {
  Mesh mesh;
  ShapeBuilder b(mesh, room.world.materials, 8);
  const double r = kBalloonRadius;
  b.ellipsoid({0, 0, 0}, {r, r, 1.15 * r}, room.materials.red_glaze, 36);
  b.revolve({0, 0, -1.15 * r - 0.018}, {{0.014, 0}, {0.004, 0.02}}, 10,
            room.materials.red_glaze);  // the knot
  return mesh;
}

Mesh side_table_mesh(const Room& room) {
  const RoomMaterials& m = room.materials;
  Mesh mesh;
  ShapeBuilder b(mesh, room.world.materials, 9);
  constexpr double kWidth = 0.6, kDepth = 0.45, kTop = 0.03, kLeg = 0.035;
  b.box({0, 0, kSideTableHeight - kTop}, {kWidth, kDepth, kTop}, m.desk_wood);
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5})
      b.box({x * (kWidth - 0.06), y * (kDepth - 0.06), 0}, {kLeg, kLeg, kSideTableHeight - kTop}, m.metal);
  }
  return mesh;
}

Mesh lens_cover_mesh(const Room& room) {
  Mesh mesh;
  ShapeBuilder b(mesh, room.world.materials, 13);
  b.box({0, 0, -kCoverHeight / 2}, {kCoverWidth, 0.01, kCoverHeight}, room.materials.black_plastic);
  return mesh;
}

}  // namespace stdc::simulation
