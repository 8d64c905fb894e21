// The trolley of loose_objects.hpp.
#include "core/random.hpp"
#include "simulation/scene/clutter.hpp"
#include "simulation/scene/loose_objects.hpp"

namespace stdc::simulation {

Mesh trolley_mesh(const Room& room) {
  const RoomMaterials& m = room.materials;
  Mesh mesh;
  ShapeBuilder b(mesh, room.world.materials, 12);
  constexpr double kLength = 0.8, kWidth = 0.46, kLow = 0.22, kHigh = 0.78, kHandle = 1.02;
  const double x = kLength / 2 - 0.03, y = kWidth / 2 - 0.03;
  for (const double z : {kLow, kHigh}) b.box({0, 0, z}, {kLength, kWidth, 0.025}, m.yellow_paint);
  for (const double sx : {-1.0, 1.0}) {
    for (const double sy : {-1.0, 1.0}) {
      b.rod({{sx * x, sy * y, 0.08}, {sx * x, sy * y, 0.4}, {sx * x, sy * y, sx < 0 ? kHandle : kHigh}},
            0.014, m.metal);
      b.ellipsoid({sx * x, sy * y, 0.06}, {0.06, 0.018, 0.06}, m.black_plastic, 18);
    }
  }
  b.rod({{-x, -y, kHandle}, {-x, 0, kHandle}, {-x, y, kHandle}}, 0.014, m.black_plastic);
  // Its load.
  b.box({-0.16, 0.02, kHigh + 0.025}, {0.36, 0.3, 0.3}, m.cardboard);
  b.box({0.2, -0.02, kHigh + 0.025}, {0.26, 0.34, 0.22}, m.packages.pick(5));
  b.box({0.05, 0, kLow + 0.025}, {0.5, 0.34, 0.3}, m.packages.pick(2));
  Random random(12, 15);
  b.world_from_local = placed(0.2, -0.02, kHigh + 0.245, 0.2);
  add_book_pile(b, m, 4, random);
  b.world_from_local = placed(-0.33, 0, kLow + 0.025);
  add_bottle(b, m, random);
  return mesh;
}

}  // namespace stdc::simulation
