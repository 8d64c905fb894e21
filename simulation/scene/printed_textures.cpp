#include "simulation/scene/printed_textures.hpp"

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>

#include "simulation/scene/picture_paint.hpp"

namespace stdc::simulation {
namespace {

PictureSheet make_atlas(int width, int height, int columns, int rows, std::uint64_t seed,
                        const std::function<void(Canvas&, Random&, int)>& paint) {
  Random random(seed);
  Canvas canvas(width, height, kPaperWhite);
  for (int i = 0; i < columns * rows; ++i) {
    Canvas part(canvas, static_cast<double>(i % columns) / columns, static_cast<double>(i / columns) / rows,
                1.0 / columns, 1.0 / rows);
    paint(part, random, i);
  }
  return {canvas.image(), columns, rows};
}

/// Text from top to bottom, as on a spine: painted lying, then rotated.
void vertical_text(Canvas& canvas, const std::string& words, double start, double height,
                   const Paint& paint) {
  Canvas lying(canvas.height(), canvas.width(), paint);
  cv::rotate(canvas.image(), lying.image(), cv::ROTATE_90_COUNTERCLOCKWISE);
  lying.text(words, start, 0.5 + height / 2, height, paint, 1);
  cv::Mat rotated;
  cv::rotate(lying.image(), rotated, cv::ROTATE_90_CLOCKWISE);
  rotated.copyTo(canvas.image());
}

void paint_spine(Canvas& c, Random& random, int /*index*/) {
  const Paint ground = random.uniform() < 0.2 ? Paint{225, 220, 205} : strong_colour(random);
  const Paint print = ground.red + ground.green + ground.blue > 380 ? kInk : Paint{238, 225, 180};
  c.fill(ground);
  vertical_text(c, pseudo_title(random, 2), random.uniform(0.12, 0.2), random.uniform(0.28, 0.45), print);
  switch (random.below(4)) {
    case 0:
      for (const double y : {0.04, 0.07, 0.92, 0.95}) c.rectangle(0, y, 1, 0.012, print);
      break;
    case 1:
      c.rectangle(0, 0.82, 1, 0.18, strong_colour(random));
      break;
    case 2:
      c.disc(0.5, 0.91, 0.28, print);
      c.disc(0.5, 0.91, 0.14, ground);
      break;
    default:
      c.rectangle(0.1, 0.86, 0.8, 0.1, kPaperWhite);
      c.rectangle(0.2, 0.89, 0.6, 0.012, kInk);
      c.rectangle(0.2, 0.92, 0.5, 0.012, kInk);
  }
  c.rectangle(0, 0, 0.05, 1, scaled(ground, 0.55));  // the rounding of the back
  c.rectangle(0.95, 0, 0.05, 1, scaled(ground, 0.55));
}

void paint_cover(Canvas& c, Random& random, int /*index*/) {
  const Paint ground = strong_colour(random);
  c.gradient(ground, scaled(ground, random.uniform(0.5, 1.4)));
  const Paint print = ground.red + ground.green + ground.blue > 380 ? kInk : kPaperWhite;
  const int shapes = 4 + static_cast<int>(random.below(14));
  for (int i = 0; i < shapes; ++i) {
    const double x = random.uniform(0.1, 0.9), y = random.uniform(0.38, 0.78), r = random.uniform(0.03, 0.16);
    const Paint p = strong_colour(random);
    if (random.below(2) == 0) {
      c.disc(x, y, r, p);
      c.ring(x, y, r * 0.7, print, 2);
    } else {
      c.rectangle(x - r, y - r / 2, 1.6 * r, r, p);
      c.frame(x - r, y - r / 2, 1.6 * r, r, print, 1);
    }
  }
  c.text(pseudo_title(random, 1), 0.08, 0.14, 0.055, print, 2);
  c.text(pseudo_title(random, 2), 0.08, 0.22, 0.04, print, 1);
  c.text(pseudo_title(random, 2), 0.1, 0.92, 0.025, print, 1);
  c.frame(0.03, 0.02, 0.94, 0.96, print, 1);
}

void paint_page(Canvas& c, Random& random, int index) {
  c.fill({238, 238, 232});
  c.text(pseudo_title(random, 3), 0.12, 0.09, 0.022, kInk, 1);
  if (index % 4 == 3) {  // a sketch by hand
    for (int i = 0; i < 24; ++i) {
      const double x = random.uniform(0.1, 0.8), y = random.uniform(0.15, 0.85);
      c.line(x, y, x + random.uniform(-0.2, 0.2), y + random.uniform(-0.1, 0.1), {40, 60, 150}, 1);
      if (i % 5 == 0) c.ring(x, y, random.uniform(0.03, 0.09), {40, 60, 150}, 1);
    }
    return;
  }
  for (int column = 0; column < 2; ++column) {
    const double x = 0.1 + 0.42 * column;
    const double figure = random.uniform(0.15, 0.55);
    c.paragraph(x, 0.13, 0.38, figure - 0.13, 0.02, {70, 70, 76}, random);
    Canvas plot(c, x, figure + 0.02, 0.38, 0.2);
    if (random.below(2) == 0) {
      paint_plot(plot, random);
    } else {
      paint_bars(plot, random);
    }
    c.paragraph(x, figure + 0.24, 0.38, 0.7 - figure, 0.02, {70, 70, 76}, random);
  }
}

void paint_package(Canvas& c, Random& random, int /*index*/) {
  const Paint ground = random.uniform() < 0.3 ? kPaperWhite : strong_colour(random),
              accent = strong_colour(random);
  const Paint print = ground.red + ground.green + ground.blue > 380 ? kInk : kPaperWhite;
  c.fill(ground);
  for (int side = 0; side < 2; ++side) {  // front and back, half of the picture each
    const double x = 0.5 * side;
    c.rectangle(x, 0.1, 0.5, 0.08, accent);
    c.disc(x + 0.25, 0.42, 0.17, accent);
    c.disc(x + 0.25, 0.42, 0.12, kPaperWhite);
    c.text(pseudo_title(random, 1), x + 0.1, 0.44, 0.05, kInk, 2);
    c.text(pseudo_title(random, 1), x + 0.06, 0.7, 0.06, print, 2);
    c.paragraph(x + 0.05, 0.76, 0.4, 0.12, 0.024, print, random);
    for (double b = x + 0.3; b < x + 0.45; b += random.uniform(0.008, 0.018)) {
      c.rectangle(b, 0.9, 0.006, 0.07, kInk);
    }
  }
}

void paint_note(Canvas& c, Random& random, int index) {
  switch (index % 4) {
    case 0: {
      c.fill(hue_paint(random.uniform(0.1, 0.2), 0.6, 0.95));
      for (double y = 0.2; y < 0.9; y += 0.17) {
        c.line(0.1, y, random.uniform(0.5, 0.9), y + random.uniform(-0.03, 0.03), {40, 40, 90}, 2);
      }
      break;
    }
    case 1:
      paint_landscape(c, random);
      c.frame(0, 0, 1, 1, kPaperWhite, 6);
      break;
    case 2:
      paint_shapes(c, random);
      break;
    default:
      c.fill({236, 236, 230});
      c.rectangle(0, 0, 1, 0.25, strong_colour(random));
      c.paragraph(0.1, 0.3, 0.8, 0.6, 0.09, kInk, random);
  }
}

}  // namespace

PictureArea PictureSheet::area(int index) const {
  const int i = index % count();
  const float w = 1.0F / static_cast<float>(columns), h = 1.0F / static_cast<float>(rows);
  const float u = static_cast<float>(i % columns) * w, v = static_cast<float>(i / columns) * h;
  const float margin_u = 0.5F / static_cast<float>(image.cols),
              margin_v = 0.5F / static_cast<float>(image.rows);
  return {u + margin_u, v + margin_v, u + w - margin_u, v + h - margin_v};
}

PictureSheet book_spines(std::uint64_t seed) { return make_atlas(1024, 1024, 16, 4, seed, paint_spine); }
PictureSheet book_covers(std::uint64_t seed) { return make_atlas(1024, 1024, 4, 2, seed, paint_cover); }
PictureSheet paper_pages(std::uint64_t seed) { return make_atlas(1024, 1024, 4, 2, seed, paint_page); }
PictureSheet packages(std::uint64_t seed) { return make_atlas(1024, 512, 4, 2, seed, paint_package); }
PictureSheet posters(std::uint64_t seed) { return make_atlas(2048, 1024, 4, 2, seed, paint_poster); }
PictureSheet small_prints(std::uint64_t seed) { return make_atlas(512, 512, 4, 4, seed, paint_note); }

}  // namespace stdc::simulation
