#include "simulation/scene/furniture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stdc::simulation {
namespace {

using Eigen::Vector3d;

/// Runs `build` in a frame given relative to the builder's present one.
template <typename Build>
void within(ShapeBuilder& b, const Pose& local, Build&& build) {
  const Pose outer = b.world_from_local;
  b.world_from_local = outer * local;
  build();
  b.world_from_local = outer;
}

Pose tilted(const Vector3d& at, const Vector3d& axis, double radians) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(radians, axis)), at};
}

}  // namespace

void add_desk(ShapeBuilder& b, const RoomMaterials& m, double width, double depth) {
  constexpr double kTop = 0.03, kLeg = 0.05;
  b.box({0, 0, kDeskHeight - kTop}, {width, depth, kTop}, m.desk_wood);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      b.box({x * (width / 2 - 0.06), y * (depth / 2 - 0.06), 0}, {kLeg, kLeg, kDeskHeight - kTop}, m.metal);
    }
    b.box({x * (width / 2 - 0.06), 0, 0.08}, {0.03, depth - 0.2, 0.03}, m.metal);
  }
  b.box({0, depth / 2 - 0.05, 0.3}, {width - 0.16, 0.015, kDeskHeight - kTop - 0.3}, m.white_plastic);
  b.box({width / 2 - 0.33, 0.02, 0.06}, {0.4, depth - 0.16, 0.56}, m.white_plastic);  // drawers
  for (int i = 0; i < 3; ++i) {
    const double z = 0.08 + 0.18 * i;
    b.box({width / 2 - 0.33, 0.02 - (depth - 0.16) / 2 - 0.008, z}, {0.38, 0.012, 0.165}, m.shelf_wood);
    b.box({width / 2 - 0.33, 0.02 - (depth - 0.16) / 2 - 0.02, z + 0.11}, {0.12, 0.012, 0.015}, m.metal);
  }
}

void add_office_chair(ShapeBuilder& b, const RoomMaterials& m) {
  for (int i = 0; i < 5; ++i) {
    const double a = 2 * std::numbers::pi * i / 5 + 0.3, c = std::cos(a), s = std::sin(a);
    b.rod({{0, 0, 0.11}, {0.15 * c, 0.15 * s, 0.095}, {0.28 * c, 0.28 * s, 0.07}}, 0.018, m.black_plastic);
    b.ellipsoid({0.28 * c, 0.28 * s, 0.03}, {0.03, 0.03, 0.03}, m.black_plastic, 10);
  }
  b.cylinder({0, 0, 0.09}, 0.028, kSeatHeight - 0.15, m.metal, m.metal, 14);
  b.box({0, 0, kSeatHeight - 0.085}, {0.3, 0.3, 0.02}, m.black_plastic);
  // The cushion's rounded edge is a stack of slabs.
  b.box({0, 0, kSeatHeight - 0.065}, {0.46, 0.44, 0.05}, m.chair_cloth);
  b.box({0, 0, kSeatHeight - 0.015}, {0.43, 0.41, 0.02}, m.chair_cloth);
  b.rod({{0, 0.2, kSeatHeight - 0.05}, {0, 0.27, kSeatHeight + 0.02}, {0, 0.28, kSeatHeight + 0.2}}, 0.02,
        m.black_plastic);
  std::vector<std::vector<Vector3d>> front, back;  // the back rest is bent round the sitter
  for (int r = 0; r <= 6; ++r) {
    front.emplace_back();
    back.emplace_back();
    const double z = kSeatHeight + 0.12 + 0.42 * r / 6;
    const double half = 0.215 * (1 - 0.12 * std::pow(std::abs(r / 3.0 - 1), 3));
    for (int c = 0; c <= 8; ++c) {
      const double x = half * (c / 4.0 - 1);
      const double y = 0.235 + 0.05 * (r / 6.0) - 0.7 * x * x;
      front.back().emplace_back(x, y, z);
      back.back().emplace_back(-x, y + 0.045, z);
    }
  }
  b.sheet(front, m.chair_cloth);
  b.sheet(back, m.black_plastic);
  for (const std::size_t r : {std::size_t{0}, front.size() - 1}) {
    std::vector<Vector3d> edge;
    for (const Vector3d& p : front[r]) edge.push_back(p + Vector3d(0, 0.0225, 0));
    b.rod(edge, 0.024, m.chair_cloth);
  }
  for (const std::size_t c : {std::size_t{0}, front[0].size() - 1}) {
    std::vector<Vector3d> edge;
    for (const auto& row : front) edge.push_back(row[c] + Vector3d(0, 0.0225, 0));
    b.rod(edge, 0.024, m.chair_cloth);
  }
  for (const double side : {-1.0, 1.0}) {
    b.rod({{side * 0.2, 0.05, kSeatHeight - 0.06},
           {side * 0.27, 0.05, kSeatHeight - 0.02},
           {side * 0.275, 0.06, kSeatHeight + 0.2}},
          0.015, m.black_plastic);
    b.box({side * 0.275, 0.03, kSeatHeight + 0.2}, {0.05, 0.24, 0.025}, m.black_plastic);
  }
}

void add_book_row(ShapeBuilder& b, const RoomMaterials& m, double width, double height, double depth,
                  Random& random) {
  double x = 0;
  while (x < width) {
    const double thick = random.uniform(0.015, 0.055);
    if (x + thick > width) break;
    const double tall = height * random.uniform(0.62, 0.97),
                 deep = std::min(depth, random.uniform(0.14, 0.24));
    const double inset = random.uniform(0, 0.025);
    const std::uint32_t book = random.below(64);
    const Finish cover = m.covers.pick(book);
    BoxFinish finish{m.spines.pick(book), cover, Finish{-1, {}}, cover, m.paper_edge, Finish{-1, {}}};
    const bool leaning = random.uniform() < 0.06 && x + thick + 0.06 < width;
    const double lean = leaning ? -0.16 : 0;
    within(b, tilted({x + (leaning ? 0.05 : 0), inset, 0}, Vector3d::UnitY(), lean), [&] {
      b.box({thick / 2, deep / 2, 0}, {thick - 0.001, deep, tall}, finish);
    });
    x += thick + (leaning ? 0.07 : 0) + (random.uniform() < 0.05 ? random.uniform(0.02, 0.09) : 0);
  }
}

void add_bookshelf(ShapeBuilder& b, const RoomMaterials& m, double width, double height, Random& random) {
  constexpr double kDepth = 0.3, kBoard = 0.02;
  const int levels = std::max(1, static_cast<int>(std::lround((height - 0.1) / 0.36)));
  const double step = (height - 0.08 - kBoard) / levels;
  for (const double x : {-1.0, 1.0})
    b.box({x * (width - kBoard) / 2, 0, 0}, {kBoard, kDepth, height}, m.shelf_wood);
  b.box({0, kDepth / 2 - 0.006, 0.06}, {width - 2 * kBoard, 0.008, height - 0.07}, m.shelf_wood);
  for (int i = 0; i <= levels; ++i) {
    const double z = 0.06 + i * step;
    b.box({0, 0, z}, {width - 2 * kBoard, kDepth - 0.012, kBoard}, m.shelf_wood);
    if (i == levels) break;
    double x = -width / 2 + kBoard + 0.01;
    const double end = width / 2 - kBoard - 0.01;
    while (end - x > 0.1) {
      const double length = std::min(end - x, random.uniform(0.25, 0.6));
      within(b, placed(x, -kDepth / 2 + 0.015, z + kBoard), [&] {
        const double room = step - kBoard - 0.02;
        switch (random.below(5)) {
          case 0: {  // a box or two
            const double w = length - 0.04, h = room * random.uniform(0.5, 0.9);
            b.box({length / 2, 0.13, 0}, {w, 0.22, h},
                  random.below(2) == 0 ? m.cardboard : m.packages.pick(random.next()));
            break;
          }
          case 1: {  // books lying
            double top = 0;
            for (int k = 0; k < 5 && top < room - 0.07; ++k) {
              const double thick = random.uniform(0.02, 0.05);
              const Finish cover = m.covers.pick(random.next());
              const BoxFinish faces{
                  m.spines.pick(random.next()), m.paper_edge, cover, m.paper_edge, cover, cover};
              b.box({length / 2, 0.12, top}, {std::min(0.24, length - 0.03), 0.18, thick}, faces);
              top += thick;
            }
            break;
          }
          default:
            add_book_row(b, m, length, room, 0.24, random);
        }
      });
      x += length;
    }
  }
}

void add_cabinet(ShapeBuilder& b, const RoomMaterials& m, double width, double height, int drawers) {
  constexpr double kDepth = 0.45;
  b.box({0, 0, 0.03}, {width, kDepth, height - 0.03}, m.grey_plastic);
  const double step = (height - 0.05) / drawers;
  for (int i = 0; i < drawers; ++i) {
    const double z = 0.04 + i * step;
    b.box({0, -kDepth / 2 - 0.006, z}, {width - 0.02, 0.012, step - 0.012}, m.white_plastic);
    b.box({0, -kDepth / 2 - 0.022, z + 0.6 * step}, {0.14, 0.02, 0.018}, m.metal);
    b.rectangle({-0.05, -kDepth / 2 - 0.0135, z + 0.72 * step}, {0.1, 0, 0}, {0, 0, 0.16 * step},
                m.notes.pick(4 * i + 3));
  }
}

void add_monitor(ShapeBuilder& b, const RoomMaterials& m, double width, int picture) {
  const double height = width * 0.6, low = 0.13;
  b.cylinder({0, 0.02, 0}, 0.12, 0.012, m.screen_frame, m.screen_frame, 24);
  b.box({0, 0.04, 0.01}, {0.06, 0.03, low + 0.1}, m.screen_frame);
  b.box({0, 0, low}, {width, 0.035, height}, m.screen_frame);
  b.box({0, 0.03, low + 0.06}, {width * 0.6, 0.03, height * 0.6}, m.black_plastic);
  const double border = 0.018;
  const Vector3d corner(-width / 2 + border, -0.0185, low + border + 0.008);
  b.rectangle(corner, {width - 2 * border, 0, 0}, {0, 0, height - 2 * border - 0.008},
              picture < 0 ? m.screen_frame : m.screens.pick(static_cast<std::uint32_t>(picture)));
  b.box({width / 2 - 0.06, -0.019, low + 0.006}, {0.05, 0.001, 0.008}, m.white_plastic);
}

}  // namespace stdc::simulation
