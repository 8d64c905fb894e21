#include "simulation/scene/room_island.hpp"

#include <numbers>

#include "simulation/scene/clutter.hpp"
#include "simulation/scene/furniture.hpp"
#include "simulation/scene/room_plan.hpp"

namespace stdc::simulation {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;
constexpr int kBoxDesk = 0;  // the desk that a box is put on

/// One of the four places at the island; the sitter looks north in its frame.
void add_workplace(ShapeBuilder& b, const RoomMaterials& m, const Pose& at, int number, Random& random) {
  b.world_from_local = at;
  add_desk(b, m, RoomPlan::kIslandX - 0.005, 0.8);
  const Pose top = at * placed(0, 0, kDeskHeight);
  const auto put = [&](double x, double y, double yaw) { b.world_from_local = top * placed(x, y, 0, yaw); };
  put(-0.12, 0.16, random.uniform(-0.15, 0.15));
  add_monitor(b, m, 0.5 + 0.05 * (number % 2), number % 4);
  put(-0.14, -0.12, random.uniform(-0.08, 0.08));
  add_keyboard(b, m);
  put(0.17, -0.12, random.uniform(-0.4, 0.2));
  add_mouse(b, m);
  put(0.45, -0.05, 0);
  add_papers(b, m, 5, 0.3, 0.35, random);
  put(-0.5, -0.1, 0);
  add_papers(b, m, 3, 0.12, 0.3, random);
  put(0.55, 0.2, random.uniform(-0.3, 0.3));
  if (number % 2 == 0) {
    add_telephone(b, m);
  } else {
    add_book_pile(b, m, 4, random);
  }
  put(0.3, 0.2, random.uniform(-1, 1));
  add_pen_holder(b, m, random);
  put(0.4, -0.12, random.uniform(-1, 1));
  add_mug(b, m, random);
  put(-0.55, 0.27, random.uniform(-0.4, 0.4));
  if (number % 2 == 0) {
    add_book_pile(b, m, 5, random);
  } else {
    add_desk_lamp(b, m);
  }
  if (number != kBoxDesk) {  // the preset moving-box needs the space
    put(-0.55, -0.22, random.uniform(-0.4, 0.4));
    add_book_pile(b, m, 2, random);
  }
  put(0.62, -0.22, random.uniform(-0.4, 0.4));
  add_tin(b, m, random);
  put(0.2, 0.32, random.uniform(-0.4, 0.4));
  add_carton(b, m, random);
  put(-0.38, 0.06, random.uniform(-0.4, 0.4));
  add_bottle(b, m, random);
  put(0, 0, 0);
  add_cable(b, m, {0.17, -0.07}, {0.12, 0.36}, random);
  add_cable(b, m, {-0.1, -0.04}, {-0.3, 0.36}, random);
}

}  // namespace

void add_island(ShapeBuilder& b, const RoomMaterials& m, Random& random) {
  const double x = RoomPlan::kIslandX / 2, south = RoomPlan::kIslandSouth + 0.4,
               north = RoomPlan::kIslandNorth - 0.4;
  add_workplace(b, m, placed(-x, south, 0), 0, random);
  add_workplace(b, m, placed(x, south, 0), 1, random);
  add_workplace(b, m, placed(-x, north, 0, 2 * kQuarterTurn), 2, random);
  add_workplace(b, m, placed(x, north, 0, 2 * kQuarterTurn), 3, random);
  b.world_from_local = placed(0.02, 1.0, kDeskHeight);
  add_fruit_bowl(b, m);
  b.world_from_local = placed(-0.45, -0.05, 0, 2 * kQuarterTurn + 0.5);
  add_office_chair(b, m);  // tucked in
  b.world_from_local = placed(0.7, 2.02, 0, 0.3);
  add_office_chair(b, m);
  b.world_from_local = placed(-2.1, -1.75, 0.003);
  b.rectangle({-0.85, -0.6, 0}, {1.7, 0, 0}, {0, 1.2, 0}, m.rug);
}

}  // namespace stdc::simulation
