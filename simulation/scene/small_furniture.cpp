// The smaller furniture of furniture.hpp: plants, stands, lamps, radiators.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/scene/furniture.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3d;

/// A leaf that rises from `root` in a direction and bends over by its weight.
void add_leaf(ShapeBuilder& b, const RoomMaterials& m, const Vector3d& root, double azimuth, double length,
              double rise) {
  const Vector3d out(std::cos(azimuth), std::sin(azimuth), 0), side(-out.y(), out.x(), 0);
  std::vector<std::vector<Vector3d>> rows;
  for (int r = 0; r <= 6; ++r) {
    const double t = r / 6.0, half = 0.16 * length * std::sin(std::numbers::pi * (0.08 + 0.9 * t));
    const Vector3d spine =
        root + out * (length * (0.35 * t + 0.5 * t * t)) + Vector3d(0, 0, rise * length * (t - 0.75 * t * t));
    rows.push_back({spine - half * side + Vector3d(0, 0, 0.3 * half), spine,
                    spine + half * side + Vector3d(0, 0, 0.3 * half)});
  }
  b.sheet(rows, m.leaf);
}

}  // namespace

void add_plant(ShapeBuilder& b, const RoomMaterials& m, double height, Random& random) {
  const double pot = 0.16 + 0.1 * height, radius = 0.09 + 0.06 * height;
  b.revolve({0, 0, 0},
            {{0.01, 0}, {0.75 * radius, 0}, {radius, pot}, {0.92 * radius, pot}, {0.9 * radius, pot - 0.03}},
            20, m.clay);
  b.revolve({0, 0, 0}, {{0.9 * radius, pot - 0.03}, {0.001, pot - 0.025}}, 20, m.soil);
  const int stems = 3 + static_cast<int>(4 * height);
  for (int i = 0; i < stems; ++i) {
    const double a = random.uniform(0, 2 * std::numbers::pi), lean = random.uniform(0.02, 0.12) * height;
    const double top = pot + (height - pot) * random.uniform(0.35, 0.8);
    const Vector3d root(0.3 * radius * std::cos(a), 0.3 * radius * std::sin(a), pot - 0.03);
    const Vector3d tip(root.x() + lean * std::cos(a), root.y() + lean * std::sin(a), top);
    b.rod({root, 0.5 * (root + tip) + Vector3d(0.01, 0.01, 0), tip}, 0.007, m.green_paint, 6);
    for (int k = 0; k < 6; ++k) {
      const Vector3d at = root + (tip - root) * (0.45 + 0.11 * k);
      add_leaf(b, m, at, a + 2.4 * k + random.uniform(-0.4, 0.4), height * random.uniform(0.22, 0.34),
               random.uniform(0.5, 1.1));
    }
  }
}

void add_coat_stand(ShapeBuilder& b, const RoomMaterials& m, Random& random) {
  b.cylinder({0, 0, 0}, 0.19, 0.025, m.metal, m.metal, 24);
  b.cylinder({0, 0, 0.025}, 0.018, 1.7, m.metal, m.metal, 12);
  for (int i = 0; i < 4; ++i) {
    const double a = std::numbers::pi * i / 2 + 0.4;
    b.rod({{0, 0, 1.62},
           {0.09 * std::cos(a), 0.09 * std::sin(a), 1.66},
           {0.14 * std::cos(a), 0.14 * std::sin(a), 1.74}},
          0.009, m.metal);
  }
  for (int coat = 0; coat < 2; ++coat) {  // cloth hanging in folds
    const double a0 = 0.4 + std::numbers::pi * coat;
    std::vector<std::vector<Vector3d>> rows;
    const double length = random.uniform(0.75, 1.05), phase = random.uniform(0, 6);
    for (int r = 0; r <= 10; ++r) {
      const double t = 1 - r / 10.0;
      rows.emplace_back();
      for (int c = 0; c <= 16; ++c) {
        const double s = c / 16.0 * 2 * std::numbers::pi;
        const double reach = (0.05 + 0.11 * std::sqrt(t)) * (1 + 0.16 * t * std::sin(5 * s + phase));
        const Vector3d middle(0.12 * std::cos(a0), 0.12 * std::sin(a0), 1.67 - length * t);
        rows.back().emplace_back(
            middle + Vector3d(reach * std::cos(s), 0.7 * reach * std::sin(s), 0.01 * std::sin(3 * s)));
      }
    }
    b.sheet(rows, coat == 0 ? m.chair_cloth : m.curtain);
  }
}

void add_bin(ShapeBuilder& b, const RoomMaterials& m) {
  b.revolve({0, 0, 0}, {{0.001, 0}, {0.11, 0}, {0.14, 0.32}, {0.132, 0.32}, {0.105, 0.01}, {0.001, 0.01}}, 24,
            m.grey_plastic);
  b.ellipsoid({0.02, 0.01, 0.25}, {0.07, 0.06, 0.06}, m.paper_edge, 9);
  b.ellipsoid({-0.05, -0.03, 0.28}, {0.05, 0.05, 0.045}, m.paper_edge, 8);
}

void add_radiator(ShapeBuilder& b, const RoomMaterials& m, double width) {
  const int ribs = static_cast<int>(width / 0.06);
  for (int i = 0; i < ribs; ++i) {
    b.box({-width / 2 + 0.03 + i * 0.06, -0.07, 0.12}, {0.045, 0.09, 0.55}, m.white_plastic);
  }
  b.rod({{-width / 2, -0.07, 0.16}, {0, -0.07, 0.16}, {width / 2 + 0.08, -0.07, 0.16}}, 0.014,
        m.white_plastic);
  b.rod({{-width / 2, -0.07, 0.63}, {0, -0.07, 0.63}, {width / 2, -0.07, 0.63}}, 0.014, m.white_plastic);
  b.cylinder({width / 2 + 0.06, -0.07, 0.14}, 0.025, 0.07, m.white_plastic, m.white_plastic, 12);
}

void add_floor_lamp(ShapeBuilder& b, const RoomMaterials& m) {
  b.cylinder({0, 0, 0}, 0.14, 0.02, m.black_plastic, m.black_plastic, 24);
  b.cylinder({0, 0, 0.02}, 0.011, 1.5, m.metal, m.metal, 10);
  b.revolve({0, 0, 1.42}, {{0.17, 0}, {0.1, 0.26}}, 28, m.paper_edge);
  b.revolve({0, 0, 1.42}, {{0.098, 0.26}, {0.168, 0}}, 28, m.paper_edge);
}

}  // namespace stdc::simulation
