#include "simulation/scene/picture_paint.hpp"

#include <algorithm>
#include <cmath>

namespace stdc::simulation {
namespace {

void paint_map(Canvas& c, Random& random) {
  c.fill({196, 218, 232});
  const cv::Mat height = fractal_noise(c.width(), c.height(), 3, 3, 6, random.next());
  for (int y = 0; y < c.height(); ++y) {
    for (int x = 0; x < c.width(); ++x) {
      const float h = height.at<float>(y, x);
      if (h < 0) continue;
      const Paint p = mixed({214, 222, 170}, {150, 110, 70}, std::min(1.0F, 1.4F * h));
      const bool contour = std::fmod(h * 20.0F, 1.0F) < 0.12F;
      const double dark = contour ? 0.75 : 1;
      c.image().at<cv::Vec3b>(y, x) = {static_cast<std::uint8_t>(p.blue * dark),
                                       static_cast<std::uint8_t>(p.green * dark),
                                       static_cast<std::uint8_t>(p.red * dark)};
    }
  }
  for (int i = 0; i < 26; ++i) {
    const double x = random.uniform(0.03, 0.8), y = random.uniform(0.05, 0.97);
    c.disc(x, y, 0.007, {190, 30, 30});
    c.text(pseudo_word(random), x + 0.02, y + 0.01, 0.014, kInk);
  }
  for (int i = 1; i < 6; ++i) {
    c.line(i / 6.0, 0, i / 6.0, 1, {120, 140, 170}, 1);
    c.line(0, i / 6.0, 1, i / 6.0, {120, 140, 170}, 1);
  }
  c.frame(0, 0, 1, 1, kPaperWhite, 6);
}

void paint_conference_poster(Canvas& c, Random& random) {
  const Paint head = hue_paint(random.uniform(), 0.75, 0.5);
  c.fill({250, 250, 248});
  c.rectangle(0, 0, 1, 0.13, head);
  c.text(pseudo_title(random, 3), 0.05, 0.065, 0.032, kPaperWhite, 2);
  c.text(pseudo_title(random, 4), 0.05, 0.11, 0.016, kPaperWhite, 1);
  for (int column = 0; column < 2; ++column) {
    double y = 0.16;
    const double x = 0.04 + column * 0.48;
    while (y < 0.9) {
      c.rectangle(x, y, 0.44, 0.026, scaled(head, 1.2));
      c.text(pseudo_word(random), x + 0.02, y + 0.021, 0.014, kPaperWhite);
      y += 0.035;
      const double h = std::min(random.uniform(0.12, 0.22), 0.96 - y);
      if (random.uniform() < 0.5) {
        c.paragraph(x, y, 0.44, h, 0.013, {60, 60, 64}, random);
      } else {
        Canvas figure(c, x + 0.02, y, 0.4, h - 0.015);
        switch (random.below(3)) {
          case 0:
            paint_plot(figure, random);
            break;
          case 1:
            paint_bars(figure, random);
            break;
          default:
            paint_landscape(figure, random);
        }
      }
      y += h + 0.01;
    }
  }
}

}  // namespace

Paint strong_colour(Random& random) {
  return hue_paint(random.uniform(), random.uniform(0.35, 0.9), random.uniform(0.3, 0.85));
}

void paint_plot(Canvas& c, Random& random) {
  c.fill({252, 252, 250});
  c.line(0.1, 0.05, 0.1, 0.9, kInk, 1);
  c.line(0.1, 0.9, 0.95, 0.9, kInk, 1);
  const int curves = 1 + static_cast<int>(random.below(3));
  for (int k = 0; k < curves; ++k) {
    const Paint p = hue_paint(random.uniform(), 0.9, 0.7);
    double y = random.uniform(0.2, 0.8);
    for (double x = 0.1; x < 0.93; x += 0.07) {
      const double next = std::clamp(y + random.uniform(-0.15, 0.15), 0.1, 0.88);
      c.line(x, y, x + 0.07, next, p, 1);
      c.disc(x, y, 0.018, p);
      y = next;
    }
  }
}

void paint_bars(Canvas& c, Random& random) {
  c.fill({248, 248, 252});
  for (int i = 0; i < 7; ++i) {
    const double h = random.uniform(0.15, 0.8);
    c.rectangle(0.08 + i * 0.125, 0.92 - h, 0.085, h, hue_paint(random.uniform(), 0.7, 0.75));
  }
  c.line(0.04, 0.92, 0.98, 0.92, kInk, 1);
}

void paint_landscape(Canvas& c, Random& random) {
  c.gradient(hue_paint(random.uniform(0.52, 0.64), 0.5, 0.9), {235, 225, 205});
  c.disc(random.uniform(0.2, 0.8), random.uniform(0.1, 0.25), 0.06, {250, 240, 190});
  for (int layer = 0; layer < 4; ++layer) {  // ranges of hills, the nearer the darker
    const Paint p = hue_paint(random.uniform(0.22, 0.45), 0.35 + 0.1 * layer, 0.7 - 0.14 * layer);
    const double base = 0.42 + 0.15 * layer;
    for (int i = 0; i < 9; ++i) {
      const double x = random.uniform(-0.1, 1.1), w = random.uniform(0.1, 0.3);
      c.triangle({x - w, base + 0.2}, {x, base - random.uniform(0, 0.18)}, {x + w, base + 0.2},
                 scaled(p, random.uniform(0.8, 1.2)));
    }
    c.rectangle(0, base + 0.1, 1, 1, p);
  }
  for (int i = 0; i < 30; ++i) {  // trees
    const double x = random.uniform(), y = random.uniform(0.72, 0.98), s = random.uniform(0.02, 0.05);
    c.triangle({x - s, y}, {x, y - 3 * s}, {x + s, y},
               hue_paint(random.uniform(0.25, 0.4), 0.6, random.uniform(0.15, 0.45)));
  }
  c.modulate(fractal_noise(c.width(), c.height(), 16, 16, 4, random.next()), 0.15);
}

void paint_shapes(Canvas& c, Random& random) {
  const Paint ground = hue_paint(random.uniform(), 0.5, 0.9);
  c.gradient(ground, hue_paint(random.uniform(), 0.6, 0.5));
  for (int i = 0; i < 40; ++i) {
    const double x = random.uniform(), y = random.uniform(), r = random.uniform(0.01, 0.16);
    const Paint p = strong_colour(random);
    switch (random.below(4)) {
      case 0:
        c.disc(x, y, r, p);
        break;
      case 1:
        c.ring(x, y, r, p, 4);
        break;
      case 2:
        c.triangle({x - r, y + r}, {x, y - r}, {x + r, y + r}, p);
        break;
      default:
        c.rectangle(x, y, r * 1.5, r * 0.5, p);
    }
  }
  c.rectangle(0, 0.86, 1, 0.14, kInk);
  c.text(pseudo_title(random, 1), 0.08, 0.95, 0.05, kPaperWhite, 3);
}

void paint_poster(Canvas& c, Random& random, int index) {
  switch (index % 4) {
    case 0:
      paint_conference_poster(c, random);
      break;
    case 1:
      paint_landscape(c, random);
      break;
    case 2:
      paint_map(c, random);
      break;
    default:
      paint_shapes(c, random);
  }
  c.frame(0, 0, 1, 1, {90, 90, 90}, 2);
}

}  // namespace stdc::simulation
