#include "simulation/scene/room.hpp"

#include <numbers>

#include "simulation/scene/clutter.hpp"
#include "simulation/scene/furniture.hpp"
#include "simulation/scene/room_island.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kW = RoomPlan::kHalfWidth, kD = RoomPlan::kHalfDepth, kH = RoomPlan::kHeight;
constexpr double kQuarter = std::numbers::pi / 2;

// Frames of the walls: origin at the middle of the wall's foot, x to the right when facing it, -y into
// the room.
const Pose kNorth = placed(0, kD, 0), kEast = placed(kW, 0, 0, -kQuarter);
const Pose kSouth = placed(0, -kD, 0, 2 * kQuarter), kWest = placed(-kW, 0, 0, kQuarter);

/// A picture on a wall, its lower edge at height z.
void hang(ShapeBuilder& b, const Finish& picture, const Finish& edge, double x, double z, double width,
          double height, double thickness = 0.012) {
  b.box({x, -thickness / 2 - 0.002, z}, {width, thickness, height},
        BoxFinish{picture, edge, edge, edge, edge, edge});
}

void add_light(World& world, ShapeBuilder& b, const RoomMaterials& m, double x, double y) {
  constexpr double kLong = 1.2, kShort = 0.6, kDrop = 0.03;
  b.world_from_local = Pose();
  b.box({x, y, kH - kDrop}, {kLong + 0.06, kShort + 0.06, kDrop - 0.002}, m.white_plastic);
  const Vector3d corner(x - kLong / 2, y + kShort / 2, kH - kDrop - 0.004);
  b.rectangle(corner, {kLong, 0, 0}, {0, -kShort, 0}, m.light_panel);
  world.lights.push_back({corner.cast<float>(), Eigen::Vector3f(kLong, 0, 0), Eigen::Vector3f(0, -kShort, 0),
                          Rgb(6.4F, 6.2F, 5.8F)});
}

void add_shell(ShapeBuilder& b, const RoomMaterials& m) {
  b.world_from_local = Pose();
  b.rectangle({-kW, -kD, 0}, {2 * kW, 0, 0}, {0, 2 * kD, 0}, m.floor);
  b.rectangle({-kW, kD, kH}, {2 * kW, 0, 0}, {0, -2 * kD, 0}, m.ceiling);
  for (const auto& [wall, length, finish] : {std::tuple{kNorth, 2 * kW, m.brick},
                                             {kEast, 2 * kD, m.wall},
                                             {kSouth, 2 * kW, m.wall},
                                             {kWest, 2 * kD, m.wall}}) {
    b.world_from_local = wall;
    b.rectangle({-length / 2, 0, 0}, {length, 0, 0}, {0, 0, kH}, finish);
    b.box({0, -0.008, 0}, {length, 0.016, 0.09}, m.shelf_wood);  // skirting
  }
}

void add_window(World& world, ShapeBuilder& b, const RoomMaterials& m) {
  constexpr double kWide = 2.2, kTall = 1.35, kSill = 0.95, kX = 0.4;
  b.world_from_local = kEast;
  const Vector3d corner(kX - kWide / 2, -0.004, kSill);
  b.rectangle(corner, {kWide, 0, 0}, {0, 0, kTall}, m.window);
  for (int i = 0; i <= 3; ++i) {
    const double x = kX - kWide / 2 + kWide * i / 3;
    b.box({x, -0.02, kSill - 0.03}, {i % 3 == 0 ? 0.07 : 0.045, 0.04, kTall + 0.06}, m.white_plastic);
  }
  for (const double z : {kSill - 0.04, kSill + 0.95, kSill + kTall - 0.01}) {
    b.box({kX, -0.02, z}, {kWide, 0.038, 0.05}, m.white_plastic);
  }
  b.box({kX, -0.1, kSill - 0.06}, {kWide + 0.1, 0.2, 0.025}, m.white_plastic);
  for (const double side : {-1.0, 1.0}) {  // curtains in folds
    std::vector<std::vector<Vector3d>> rows(2);
    for (int c = 0; c <= 36; ++c) {
      const double x = kX + side * (kWide / 2 + 0.2) + 0.26 * (c / 18.0 - 1),
                   y = -0.12 + 0.035 * std::sin(c * 1.05);
      rows[0].emplace_back(x, y, 0.25);
      rows[1].emplace_back(x, y, kSill + kTall + 0.12);
    }
    b.sheet(rows, m.curtain);
  }
  const Vector3d low = kEast * (corner + Vector3d(0, -0.045, 0));
  const Vector3d s = kEast.rotation * Vector3d(kWide, 0, 0), t = kEast.rotation * Vector3d(0, 0, kTall);
  world.lights.push_back({low.cast<float>(), s.cast<float>(), t.cast<float>(), Rgb(1.9F, 2.1F, 2.4F)});
  b.world_from_local = kEast * placed(kX, 0, 0);
  add_radiator(b, m, 1.8);
}

void furnish_north(ShapeBuilder& b, const RoomMaterials& m, Random& random) {
  b.world_from_local = kNorth * placed(-2.7, -0.17, 0);
  add_bookshelf(b, m, 1.1, 2.0, random);
  b.world_from_local = kNorth * placed(2.55, -0.17, 0);
  add_bookshelf(b, m, 1.3, 1.35, random);
  b.world_from_local = kNorth * placed(2.55, -0.17, 1.35);
  scatter(b, m, 6, 1.1, 0.12, random);
  b.world_from_local = kNorth;
  hang(b, m.posters.pick(0), m.white_plastic, -1.45, 1.0, 0.84, 1.19);
  hang(b, m.posters.pick(2), m.white_plastic, -0.4, 1.05, 0.8, 1.1);
  hang(b, m.posters.pick(1), m.shelf_wood, 0.55, 1.25, 0.6, 0.8, 0.03);
  hang(b, m.posters.pick(7), m.white_plastic, 1.4, 1.1, 0.7, 1.0);
  hang(b, m.clock, m.black_plastic, 0.55, 2.2, 0.32, 0.32, 0.04);
  hang(b, m.posters.pick(5), m.shelf_wood, 2.55, 1.75, 0.9, 0.6, 0.03);
  b.box({0.1, -0.03, 0.25}, {2.6, 0.05, 0.07}, m.white_plastic);  // cable duct with sockets
  for (int i = 0; i < 6; ++i) b.box({-1.0 + 0.42 * i, -0.06, 0.245}, {0.08, 0.012, 0.08}, m.grey_plastic);
}

void furnish_west(ShapeBuilder& b, const RoomMaterials& m, Random& random) {
  for (const double x : {-2.2, -1.05}) {
    b.world_from_local = kWest * placed(x, -0.17, 0);
    add_bookshelf(b, m, 1.1, 2.1, random);
  }
  b.world_from_local = kWest;
  hang(b, m.door, m.door, 1.9, 0, 0.9, 2.05, 0.04);
  for (const double x : {1.41, 2.39}) b.box({x, -0.03, 0}, {0.08, 0.06, 2.1}, m.white_plastic);
  b.box({1.9, -0.03, 2.06}, {1.06, 0.06, 0.08}, m.white_plastic);
  b.rod({{1.55, -0.04, 1.05}, {1.55, -0.09, 1.05}, {1.68, -0.09, 1.05}}, 0.011, m.metal);
  hang(b, m.notes.pick(3), m.white_plastic, 1.9, 1.5, 0.2, 0.14, 0.004);
  hang(b, m.posters.pick(4), m.white_plastic, 0.35, 1.0, 0.8, 1.15);
  hang(b, m.calendar, m.white_plastic, 1.08, 1.2, 0.3, 0.6);
  b.box({0.98, -0.006, 1.05}, {0.08, 0.012, 0.08}, m.white_plastic);
  b.world_from_local = kWest * placed(0.42, -0.26, 0);
  add_cabinet(b, m, 0.9, 0.74, 3);
  b.world_from_local = kWest * placed(0.42, -0.26, 0.74);
  scatter(b, m, 7, 0.75, 0.3, random);
}

void furnish_south(ShapeBuilder& b, const RoomMaterials& m, Random& random) {
  b.world_from_local = kSouth;
  hang(b, m.whiteboard, m.metal, -0.3, 0.95, 2.0, 1.1, 0.02);
  b.box({-0.3, -0.05, 0.94}, {1.2, 0.07, 0.015}, m.metal);
  for (int i = 0; i < 4; ++i) {
    const Finish pens[] = {m.black_plastic, m.blue_paint, m.red_paint, m.green_paint};
    b.box({-0.6 + 0.17 * i, -0.055, 0.955}, {0.13, 0.018, 0.018}, pens[i]);
  }
  hang(b, m.cork, m.shelf_wood, 1.75, 1.0, 1.2, 0.9, 0.02);
  for (int i = 0; i < 15; ++i) {  // pinned notes
    const double x = 1.25 + 0.25 * (i % 5) + random.uniform(-0.04, 0.04),
                 z = 1.08 + 0.28 * (i / 5) + random.uniform(-0.03, 0.03);
    const double size = random.uniform(0.1, 0.17);
    const Finish print = random.below(3) == 0 ? m.pages.pick(random.next()) : m.notes.pick(random.next());
    const Pose wall = b.world_from_local;
    const double tilt = random.uniform(-0.2, 0.2);
    b.world_from_local = wall * Pose(Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vector3d::UnitY())),
                                     Vector3d(x, -0.026 - 0.0008 * i, z));
    b.rectangle({-size / 2, 0, 0}, {size, 0, 0}, {0, 0, size * 1.2}, print);
    b.ellipsoid({0, -0.006, size * 1.1}, {0.008, 0.008, 0.008}, m.red_paint, 8);
    b.world_from_local = wall;
  }
  b.world_from_local = kSouth * placed(1.75, -0.26, 0);
  add_cabinet(b, m, 1.1, 0.78, 3);
  b.world_from_local = kSouth * placed(1.75, -0.25, 0.78);
  scatter(b, m, 6, 0.95, 0.25, random);
  for (int i = 0; i < 4; ++i) {  // boxes below the whiteboard, one on top of another
    const Vector3d size(random.uniform(0.34, 0.42), random.uniform(0.26, 0.34), random.uniform(0.22, 0.3));
    b.world_from_local = kSouth * placed(i < 3 ? -0.95 + 0.52 * i : -0.7, -0.22, i < 3 ? 0 : 0.305,
                                         random.uniform(-0.12, 0.12));
    b.box({0, 0, 0}, size, m.cardboard);
  }
  b.world_from_local = kSouth * placed(3.2, -0.5, 0);
  add_coat_stand(b, m, random);
  b.world_from_local = kSouth;
  hang(b, m.posters.pick(6), m.white_plastic, -2.0, 1.05, 0.8, 1.1);
  hang(b, m.posters.pick(3), m.shelf_wood, -2.95, 1.3, 0.6, 0.8, 0.03);
  b.world_from_local = kSouth * placed(-2.4, -0.17, 0);
  add_bookshelf(b, m, 1.4, 0.85, random);
  b.world_from_local = kSouth * placed(-2.4, -0.17, 0.85);
  scatter(b, m, 6, 1.2, 0.14, random);
}

void furnish_east(ShapeBuilder& b, const RoomMaterials& m, Random& random) {
  b.world_from_local = kEast * placed(-1.9, -0.17, 0);
  add_bookshelf(b, m, 1.2, 1.7, random);
  b.world_from_local = kEast;
  hang(b, m.posters.pick(9), m.white_plastic, -1.9, 1.85, 0.9, 0.6);
  hang(b, m.posters.pick(8), m.white_plastic, 2.35, 1.15, 0.7, 0.98);
  b.world_from_local = kEast * placed(2.45, -0.4, 0);
  add_plant(b, m, 1.35, random);
  b.world_from_local = kEast * placed(0.2, -0.1, 0.915);
  add_plant(b, m, 0.36, random);
  b.world_from_local = kEast * placed(1.0, -0.1, 0.915);
  add_plant(b, m, 0.3, random);
  b.world_from_local = kNorth * placed(3.35, -1.0, 0);
  add_bin(b, m);
  b.world_from_local = kNorth * placed(-3.4, -0.6, 0);
  add_floor_lamp(b, m);
}

}  // namespace

Pose visitor_chair_pose() { return placed(1.25, -0.25, 0, -kQuarter - 0.25); }

Room make_room(std::uint64_t seed, bool with_chair) {
  Room room;
  room.world.low = {-static_cast<float>(kW), -static_cast<float>(kD), 0};
  room.world.high = {static_cast<float>(kW), static_cast<float>(kD), static_cast<float>(kH)};
  room.materials = add_room_materials(room.world, seed);
  Random random(seed, 12);
  ShapeBuilder builder(room.world.mesh, room.world.materials, seed);
  add_shell(builder, room.materials);
  add_light(room.world, builder, room.materials, -1.5, -0.4);
  add_light(room.world, builder, room.materials, 1.5, 0.4);
  add_window(room.world, builder, room.materials);
  furnish_north(builder, room.materials, random);
  furnish_west(builder, room.materials, random);
  furnish_south(builder, room.materials, random);
  furnish_east(builder, room.materials, random);
  add_island(builder, room.materials, random);
  if (with_chair) {
    builder.world_from_local = visitor_chair_pose();
    add_office_chair(builder, room.materials);
  }
  return room;
}

}  // namespace stdc::simulation
