#include "simulation/scene/clutter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace stdc::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTwoPi = 2 * std::numbers::pi;

}  // namespace

void add_mug(ShapeBuilder& b, const RoomMaterials& m, Random& random) {
  const Finish glazes[] = {m.white_glaze, m.blue_glaze, m.red_glaze, m.packages.pick(random.next())};
  const Finish glaze = glazes[random.below(4)];
  const double r = random.uniform(0.038, 0.045), h = random.uniform(0.085, 0.105);
  b.revolve({0, 0, 0}, {{0.001, 0}, {0.9 * r, 0}, {r, 0.01}, {r, h}}, 24, glaze);
  b.revolve({0, 0, 0}, {{r, h}, {0.92 * r, h}, {0.9 * r, 0.2 * h}}, 24, m.white_glaze);
  b.revolve({0, 0, 0}, {{0.91 * r, 0.7 * h}, {0.001, 0.7 * h}}, 24, m.soil);  // coffee
  std::vector<Vector3d> handle;
  for (int i = 0; i <= 8; ++i) {
    const double a = std::numbers::pi * (i / 8.0 - 0.5);
    handle.emplace_back(r - 0.003 + 0.028 * std::cos(a), 0, h * 0.52 + 0.3 * h * std::sin(a));
  }
  b.rod(handle, 0.006, m.white_glaze, 8);
}

void add_bottle(ShapeBuilder& b, const RoomMaterials& m, Random& random) {
  const double r = random.uniform(0.032, 0.042), h = random.uniform(0.2, 0.28);
  b.revolve({0, 0, 0}, {{0.001, 0}, {0.9 * r, 0}, {r, 0.01}, {r, 0.25 * h}}, 20, m.glass);
  b.revolve({0, 0, 0}, {{1.01 * r, 0.25 * h}, {1.01 * r, 0.58 * h}}, 20, m.packages.pick(random.next()));
  b.revolve({0, 0, 0}, {{r, 0.58 * h}, {0.95 * r, 0.66 * h}, {0.42 * r, 0.82 * h}, {0.36 * r, 0.92 * h}}, 20,
            m.glass);
  b.revolve({0, 0, 0}, {{0.42 * r, 0.91 * h}, {0.42 * r, h}, {0.001, h}}, 16, m.blue_paint);
}

void add_tin(ShapeBuilder& b, const RoomMaterials& m, Random& random) {
  const double r = random.uniform(0.03, 0.05), h = random.uniform(0.1, 0.14);
  b.revolve({0, 0, 0}, {{0.9 * r, 0}, {r, 0.006}, {r, h - 0.006}, {0.9 * r, h}}, 24,
            m.packages.pick(random.next()));
  b.revolve({0, 0, 0}, {{0.9 * r, h}, {0.86 * r, h - 0.004}, {0.001, h - 0.004}}, 24, m.metal);
}

void add_carton(ShapeBuilder& b, const RoomMaterials& m, Random& random) {
  const Finish print = m.packages.pick(random.next());
  const double w = random.uniform(0.07, 0.2), d = random.uniform(0.05, 0.09), h = random.uniform(0.12, 0.28);
  b.box({0, 0, 0}, {w, d, h}, print);
}

void add_book_pile(ShapeBuilder& b, const RoomMaterials& m, int books, Random& random) {
  const Pose outer = b.world_from_local;
  double top = 0;
  for (int i = 0; i < books; ++i) {
    const double thick = random.uniform(0.015, 0.05), w = random.uniform(0.15, 0.21),
                 d = w * random.uniform(1.25, 1.45);
    const std::uint32_t book = random.next();
    const Finish cover = m.covers.pick(book);
    const BoxFinish faces{m.paper_edge, m.paper_edge, m.paper_edge, m.spines.pick(book), cover, cover};
    b.world_from_local = outer * placed(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), top,
                                        random.uniform(-0.4, 0.4));
    b.box({0, 0, 0}, {w, d, thick}, faces);
    top += thick + 0.0005;
  }
  b.world_from_local = outer;
}

void add_papers(ShapeBuilder& b, const RoomMaterials& m, int sheets, double width, double depth,
                Random& random) {
  const Pose outer = b.world_from_local;
  for (int i = 0; i < sheets; ++i) {
    const bool note = random.uniform() < 0.25;
    const double w = note ? 0.09 : 0.21, d = note ? 0.09 : 0.297;
    b.world_from_local =
        outer * placed(random.uniform(-width / 2, width / 2), random.uniform(-depth / 2, depth / 2),
                       0.001 + 0.0008 * i, random.uniform(-0.9, 0.9));
    b.rectangle({-w / 2, -d / 2, 0}, {w, 0, 0}, {0, d, 0},
                note ? m.notes.pick(random.next()) : m.pages.pick(random.next()));
  }
  b.world_from_local = outer;
}

void add_pen_holder(ShapeBuilder& b, const RoomMaterials& m, Random& random) {
  constexpr double kRadius = 0.04, kHeight = 0.1;
  b.revolve({0, 0, 0},
            {{0.001, 0}, {kRadius, 0}, {kRadius, kHeight}, {0.9 * kRadius, kHeight}, {0.88 * kRadius, 0.01}},
            20, m.metal);
  const Finish pens[] = {m.blue_paint, m.red_paint, m.green_paint, m.yellow_paint, m.black_plastic};
  for (int i = 0; i < 9; ++i) {
    const double a = random.uniform(0, kTwoPi), lean = random.uniform(0.4, 0.85) * kRadius;
    const double length = random.uniform(0.14, 0.18);
    const Vector3d foot(-0.6 * lean * std::cos(a), -0.6 * lean * std::sin(a), 0.012);
    const Vector3d edge(lean * std::cos(a), lean * std::sin(a), kHeight);
    const Vector3d tip = foot + (edge - foot).normalized() * length;
    b.rod({foot, 0.5 * (foot + tip), tip}, 0.0042, pens[i % 5], 6);
    b.ellipsoid(tip, {0.0046, 0.0046, 0.008}, pens[(i + 2) % 5], 6);
  }
}

void add_keyboard(ShapeBuilder& b, const RoomMaterials& m) {
  const BoxFinish faces{m.grey_plastic, m.grey_plastic, m.grey_plastic,
                        m.grey_plastic, m.keyboard,     m.grey_plastic};
  b.box({0, 0, 0}, {0.45, 0.16, 0.022}, faces);
}

void add_mouse(ShapeBuilder& b, const RoomMaterials& m) {
  b.ellipsoid({0, 0, 0.008}, {0.031, 0.056, 0.026}, m.grey_plastic, 16);
  b.box({0, -0.03, 0.028}, {0.007, 0.02, 0.008}, m.black_plastic);
}

void add_telephone(ShapeBuilder& b, const RoomMaterials& m) {
  b.box({0, 0, 0}, {0.18, 0.2, 0.035}, m.black_plastic);
  b.box({0.04, 0.06, 0.035}, {0.08, 0.05, 0.02}, m.screens.pick(3));
  for (int i = 0; i < 12; ++i) {
    b.box({0.005 + 0.028 * (i % 3), -0.07 + 0.026 * (i / 3), 0.035}, {0.02, 0.017, 0.006}, m.white_plastic);
  }
  b.rod({{-0.062, -0.09, 0.06}, {-0.062, 0, 0.075}, {-0.062, 0.09, 0.06}}, 0.017, m.black_plastic, 10);
  b.ellipsoid({-0.062, -0.085, 0.05}, {0.028, 0.026, 0.02}, m.black_plastic, 12);
  b.ellipsoid({-0.062, 0.085, 0.05}, {0.028, 0.026, 0.02}, m.black_plastic, 12);
}

void add_desk_lamp(ShapeBuilder& b, const RoomMaterials& m) {
  b.cylinder({0, 0, 0}, 0.08, 0.02, m.red_paint, m.red_paint, 20);
  b.rod({{0, 0, 0.02}, {0.01, 0.08, 0.2}, {0.01, 0.1, 0.34}}, 0.007, m.metal);
  b.rod({{0.01, 0.1, 0.34}, {0, 0.0, 0.42}, {0, -0.12, 0.46}}, 0.007, m.metal);
  b.revolve({0, -0.14, 0.38}, {{0.075, 0}, {0.03, 0.09}, {0.001, 0.1}}, 20, m.red_paint);
  b.revolve({0, -0.14, 0.38}, {{0.001, 0.085}, {0.027, 0.085}, {0.072, 0}}, 20, m.white_glaze);
}

void add_laptop(ShapeBuilder& b, const RoomMaterials& m, int picture) {
  const BoxFinish faces{m.grey_plastic, m.grey_plastic, m.grey_plastic,
                        m.grey_plastic, m.keyboard,     m.grey_plastic};
  b.box({0, 0, 0}, {0.34, 0.23, 0.018}, faces);
  const Pose outer = b.world_from_local;
  b.world_from_local =
      outer * Pose(Eigen::Quaterniond(Eigen::AngleAxisd(-0.3, Vector3d::UnitX())), Vector3d(0, 0.115, 0.018));
  b.box({0, 0, 0}, {0.34, 0.008, 0.225}, m.grey_plastic);
  b.rectangle({-0.16, -0.0055, 0.015}, {0.32, 0, 0}, {0, 0, 0.2},
              m.screens.pick(static_cast<std::uint32_t>(picture)));
  b.world_from_local = outer;
}

void add_cable(ShapeBuilder& b, const RoomMaterials& m, const Vector2d& from, const Vector2d& to,
               Random& random) {
  const Vector2d across = Vector2d(-(to - from).y(), (to - from).x());
  const double amplitude = random.uniform(0.08, 0.2), waves = random.uniform(1, 2.6),
               phase = random.uniform(0, kTwoPi);
  std::vector<Vector3d> points;
  for (int i = 0; i <= 28; ++i) {
    const double t = i / 28.0,
                 swing = amplitude * std::sin(kTwoPi * waves * t + phase) * std::sin(std::numbers::pi * t);
    const Vector2d p = from + (to - from) * t + across * swing;
    points.emplace_back(p.x(), p.y(), 0.0035);
  }
  b.rod(points, 0.003, m.cable, 6);
}

void add_fruit_bowl(ShapeBuilder& b, const RoomMaterials& m) {
  b.revolve({0, 0, 0},
            {{0.001, 0},
             {0.05, 0},
             {0.1, 0.04},
             {0.13, 0.08},
             {0.125, 0.08},
             {0.095, 0.045},
             {0.04, 0.012},
             {0.001, 0.01}},
            28, m.blue_glaze);
  b.ellipsoid({0.04, 0.02, 0.07}, {0.037, 0.037, 0.034}, m.red_paint, 14);
  b.ellipsoid({-0.04, 0.03, 0.07}, {0.036, 0.036, 0.034}, m.green_paint, 14);
  b.ellipsoid({0, -0.045, 0.072}, {0.038, 0.038, 0.036}, m.yellow_paint, 14);
  b.ellipsoid({0.005, 0.01, 0.11}, {0.036, 0.036, 0.034}, m.red_paint, 14);
}

void scatter(ShapeBuilder& b, const RoomMaterials& m, int count, double width, double depth, Random& random) {
  const Pose outer = b.world_from_local;
  std::vector<Vector2d> taken;
  for (int tries = 0; tries < 40 * count && static_cast<int>(taken.size()) < count; ++tries) {
    const Vector2d at(random.uniform(-width / 2, width / 2), random.uniform(-depth / 2, depth / 2));
    const auto near = [&](const Vector2d& other) { return (other - at).norm() < 0.17; };
    if (std::any_of(taken.begin(), taken.end(), near)) continue;
    taken.push_back(at);
    b.world_from_local = outer * placed(at.x(), at.y(), 0, random.uniform(-1.2, 1.2));
    switch (random.below(8)) {
      case 0:
        add_mug(b, m, random);
        break;
      case 1:
        add_bottle(b, m, random);
        break;
      case 2:
        add_tin(b, m, random);
        break;
      case 3:
        add_carton(b, m, random);
        break;
      case 4:
        add_book_pile(b, m, 1 + static_cast<int>(random.below(4)), random);
        break;
      case 5:
        add_pen_holder(b, m, random);
        break;
      case 6:
        add_papers(b, m, 2, 0.05, 0.05, random);
        break;
      default:
        add_mug(b, m, random);
    }
  }
  b.world_from_local = outer;
}

}  // namespace stdc::simulation
