// Screens, keyboards, boards and other pictures that are not printed on paper.
#include <algorithm>
#include <array>
#include <cmath>

#include "simulation/scene/printed_textures.hpp"

namespace stdc::simulation {
namespace {

void paint_editor(Canvas& c, Random& random, const Paint& ground, bool dark) {
  c.fill(ground);
  c.rectangle(0, 0, 1, 0.045, scaled(ground, dark ? 1.8 : 0.8));
  c.rectangle(0, 0.045, 0.17, 0.955, scaled(ground, dark ? 1.3 : 0.92));
  for (double y = 0.08; y < 0.9; y += 0.03) {
    c.rectangle(0.02 + 0.02 * random.below(3), y, random.uniform(0.04, 0.1), 0.012,
                dark ? Paint{150, 150, 160} : Paint{90, 90, 90});
  }
  double indent = 0;
  for (double y = 0.075; y < 0.96; y += 0.024) {
    if (random.uniform() < 0.12) continue;
    indent = std::clamp(indent + (random.uniform() < 0.3 ? random.uniform(-1, 1) : 0), 0.0, 4.0);
    double x = 0.2 + 0.03 * std::floor(indent);
    const int words = 2 + static_cast<int>(random.below(7));
    for (int i = 0; i < words && x < 0.9; ++i) {
      const double length = random.uniform(0.015, 0.08);
      c.rectangle(x, y, length, 0.011, hue_paint(random.uniform(), dark ? 0.5 : 0.8, dark ? 0.85 : 0.45));
      x += length + 0.012;
    }
  }
}

void paint_desktop(Canvas& c, Random& random) {
  c.gradient({30, 60, 110}, {110, 150, 190});
  for (int w = 0; w < 3; ++w) {
    const double x = 0.05 + 0.27 * w, y = random.uniform(0.08, 0.3), width = random.uniform(0.3, 0.38);
    Canvas window(c, x, y, std::min(width, 0.98 - x), 0.55);
    window.fill({244, 244, 244});
    window.rectangle(0, 0, 1, 0.07, {70, 74, 84});
    window.disc(0.95, 0.035, 0.018, {220, 80, 70});
    for (int i = 0; i < 4; ++i) {
      window.rectangle(0.06, 0.13 + 0.21 * i, 0.34, 0.16, hue_paint(random.uniform(), 0.6, 0.8));
      window.paragraph(0.45, 0.12 + 0.21 * i, 0.5, 0.16, 0.035, {60, 60, 60}, random);
    }
  }
  c.rectangle(0, 0.95, 1, 0.05, {24, 26, 32});
  for (int i = 0; i < 9; ++i)
    c.rectangle(0.02 + 0.045 * i, 0.96, 0.028, 0.03, hue_paint(random.uniform(), 0.7, 0.9));
}

void paint_curves(Canvas& c, Random& random) {
  c.fill({250, 250, 250});
  for (int k = 0; k < 4; ++k) {
    Canvas plot(c, 0.04 + 0.48 * (k % 2), 0.06 + 0.47 * (k / 2), 0.44, 0.4);
    plot.frame(0, 0, 1, 1, {20, 20, 20}, 2);
    for (double g = 0.2; g < 0.9; g += 0.2) {
      plot.line(g, 0, g, 1, {205, 205, 205}, 1);
      plot.line(0, g, 1, g, {205, 205, 205}, 1);
    }
    for (int curve = 0; curve < 3; ++curve) {
      const Paint p = hue_paint(random.uniform(), 0.9, 0.75);
      double y = random.uniform(0.3, 0.7);
      for (double x = 0; x < 0.97; x += 0.03) {
        const double next = std::clamp(y + random.uniform(-0.08, 0.08), 0.05, 0.95);
        plot.line(x, y, x + 0.03, next, p, 2);
        y = next;
      }
    }
  }
}

}  // namespace

PictureSheet screens(std::uint64_t seed) {
  Random random(seed);
  Canvas canvas(1024, 512, {0, 0, 0});
  Canvas first(canvas, 0, 0, 0.5, 0.5), second(canvas, 0.5, 0, 0.5, 0.5);
  Canvas third(canvas, 0, 0.5, 0.5, 0.5), fourth(canvas, 0.5, 0.5, 0.5, 0.5);
  paint_editor(first, random, {30, 32, 40}, true);
  paint_desktop(second, random);
  paint_curves(third, random);
  paint_editor(fourth, random, {246, 246, 240}, false);
  return {canvas.image(), 2, 2};
}

cv::Mat keyboard_texture(std::uint64_t seed) {
  Random random(seed);
  const bool dark = random.below(2) == 0;
  const Paint body = dark ? Paint{46, 46, 50} : Paint{214, 208, 194},
              key = dark ? Paint{24, 24, 26} : Paint{232, 228, 216};
  const Paint print = dark ? Paint{225, 225, 225} : Paint{50, 50, 50};
  Canvas canvas(512, 256, body);
  const auto paint_key = [&](double x, double y, double width) {
    canvas.rectangle(x, y, width - 0.005, 0.125, scaled(key, 0.55));
    canvas.rectangle(x + 0.003, y + 0.004, width - 0.012, 0.105, key);
    const std::string letter(1, static_cast<char>('A' + random.below(26)));
    canvas.text(letter, x + 0.008, y + 0.065, 0.042, print);
  };
  constexpr double kUnit = 0.043;
  for (int row = 0; row < 6; ++row) {
    const double y = 0.06 + 0.148 * row;
    if (row == 5) {
      for (int i = 0; i < 3; ++i) paint_key(0.02 + i * 0.055, y, 0.055);
      paint_key(0.02 + 0.165, y, 0.28);
      for (int i = 0; i < 4; ++i) paint_key(0.465 + i * 0.05, y, 0.05);
    } else {
      for (int i = 0; i < 15; ++i) paint_key(0.02 + i * kUnit, y, kUnit);
    }
    for (int i = 0; i < 3; ++i) {
      if (row < 2 || row == 5 || (row == 4 && i == 1)) paint_key(0.675 + i * 0.042, y, 0.042);
    }
    for (int i = 0; i < 4 && row > 0; ++i) paint_key(0.815 + i * 0.042, y, 0.042);
  }
  canvas.grain(2, random);
  return canvas.image();
}

cv::Mat whiteboard_texture(std::uint64_t seed) {
  Random random(seed);
  Canvas c(1024, 512, {238, 240, 242});
  c.modulate(fractal_noise(c.width(), c.height(), 4, 3, 3, random.next()), 0.03);
  const std::array<Paint, 4> pens{Paint{30, 30, 36}, {30, 50, 160}, {170, 30, 40}, {20, 120, 60}};
  for (int i = 0; i < 7; ++i) {
    const Paint pen = pens[random.below(4)];
    c.text(pseudo_title(random, 2), random.uniform(0.03, 0.2), 0.1 + 0.075 * i, 0.04, pen, 2);
  }
  for (int i = 0; i < 6; ++i) {  // boxes joined by arrows
    const double x = 0.52 + 0.16 * (i % 3), y = 0.2 + 0.35 * (i / 3);
    const Paint pen = pens[random.below(4)];
    c.frame(x, y, 0.11, 0.17, pen, 2);
    c.text(pseudo_word(random), x + 0.01, y + 0.1, 0.03, pen, 1);
    if (i % 3 < 2) {
      c.line(x + 0.11, y + 0.08, x + 0.16, y + 0.08, pen, 2);
      c.line(x + 0.15, y + 0.05, x + 0.16, y + 0.08, pen, 2);
      c.line(x + 0.15, y + 0.11, x + 0.16, y + 0.08, pen, 2);
    }
  }
  double y = 0.8;
  c.line(0.06, 0.95, 0.06, 0.62, pens[0], 2);
  c.line(0.06, 0.95, 0.42, 0.95, pens[0], 2);
  for (double x = 0.06; x < 0.4; x += 0.015) {
    const double next = std::clamp(y + random.uniform(-0.05, 0.045), 0.64, 0.93);
    c.line(x, y, x + 0.015, next, pens[2], 2);
    y = next;
  }
  return c.image();
}

cv::Mat outdoor_texture(std::uint64_t seed) {
  Random random(seed);
  Canvas c(512, 512, {0, 0, 0});
  c.gradient({150, 190, 235}, {225, 235, 240});
  const cv::Mat clouds = fractal_noise(512, 512, 3, 5, 5, random.next());
  c.modulate(clouds, 0.12);
  for (int i = 0; i < 7; ++i) {  // houses across the street
    const double x = -0.05 + 0.16 * i, top = random.uniform(0.3, 0.55);
    const Paint wall =
        hue_paint(random.uniform(0.02, 0.14), random.uniform(0.1, 0.45), random.uniform(0.5, 0.85));
    c.rectangle(x, top, 0.15, 1, wall);
    c.triangle({x - 0.01, top}, {x + 0.075, top - 0.1}, {x + 0.16, top}, {130, 62, 48});
    for (double wy = top + 0.04; wy < 0.8; wy += 0.085) {
      for (double wx = x + 0.02; wx < x + 0.12; wx += 0.045) {
        c.rectangle(wx, wy, 0.026, 0.05, {60, 74, 96});
        c.frame(wx, wy, 0.026, 0.05, {235, 235, 235}, 1);
      }
    }
  }
  for (int i = 0; i < 1500; ++i) {  // trees in front of them
    const double x = random.uniform(), y = 0.62 + 0.06 * std::sin(17 * x) + random.uniform(0, 0.4);
    c.disc(x, y, random.uniform(0.004, 0.018),
           hue_paint(random.uniform(0.22, 0.36), 0.6, random.uniform(0.2, 0.6)));
  }
  return c.image();
}

cv::Mat calendar_texture(std::uint64_t seed) {
  Random random(seed);
  Canvas c(256, 512, {246, 246, 244});
  c.rectangle(0, 0, 1, 0.42, hue_paint(random.uniform(), 0.6, 0.6));
  for (int i = 0; i < 14; ++i) {
    c.disc(random.uniform(), random.uniform(0.05, 0.4), random.uniform(0.02, 0.14),
           hue_paint(random.uniform(), 0.6, 0.8));
  }
  c.rectangle(0, 0.42, 1, 0.07, {180, 30, 30});
  c.text("Mai", 0.36, 0.475, 0.04, {255, 255, 255}, 2);
  for (int day = 0; day < 31; ++day) {
    c.text(std::to_string(day + 1), 0.06 + 0.13 * (day % 7), 0.57 + 0.09 * (day / 7), 0.032,
           day % 7 == 6 ? Paint{190, 30, 30} : Paint{30, 30, 30}, 1);
  }
  return c.image();
}

cv::Mat clock_texture() {
  Canvas c(256, 256, {30, 30, 32});
  c.disc(0.5, 0.5, 0.47, {244, 244, 240});
  for (int i = 0; i < 60; ++i) {
    const double a = 6.283185307 * i / 60, inner = i % 5 == 0 ? 0.37 : 0.42;
    c.line(0.5 + inner * std::sin(a), 0.5 - inner * std::cos(a), 0.5 + 0.45 * std::sin(a),
           0.5 - 0.45 * std::cos(a), {20, 20, 20}, i % 5 == 0 ? 4 : 1);
  }
  c.line(0.5, 0.5, 0.67, 0.38, {20, 20, 20}, 7);
  c.line(0.5, 0.5, 0.44, 0.13, {20, 20, 20}, 4);
  c.disc(0.5, 0.5, 0.03, {180, 30, 30});
  return c.image();
}

}  // namespace stdc::simulation
