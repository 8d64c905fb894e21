#include "simulation/scene/surface_textures.hpp"

#include <cmath>

namespace stdc::simulation {

cv::Mat wood_texture(const Paint& colour, int boards, std::uint64_t seed) {
  constexpr int kSide = 512;
  Random random(seed);
  Canvas canvas(kSide, kSide, colour);
  for (int b = 0; b < boards; ++b) {
    Canvas board(canvas, 0, static_cast<double>(b) / boards, 1, 1.0 / boards);
    board.fill(scaled(colour, random.uniform(0.85, 1.1)));
    const int w = board.width(), h = board.height();
    board.modulate(fractal_noise(w, h, 2, std::max(4, 64 / boards), 3, random.next()), 0.16);
    const cv::Mat wave = fractal_noise(w, h, 2, 3, 3, random.next());
    cv::Mat rings(h, w, CV_32FC1);  // year rings cut lengthwise: stripes bent by slow noise
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        const float phase =
            40.0F * static_cast<float>(y) / static_cast<float>(h) * 3.0F / static_cast<float>(boards) +
            9.0F * wave.at<float>(y, x);
        const float saw = phase - std::floor(phase);
        rings.at<float>(y, x) = saw * saw - 0.3F;
      }
    }
    board.modulate(rings, 0.13);
    if (boards > 1) board.line(0, 0, 1, 0, scaled(colour, 0.45), 2);
  }
  for (int i = 0; i < 3; ++i) {  // knots
    const double x = random.uniform(0.1, 0.9), y = random.uniform(0.1, 0.9), r = random.uniform(0.006, 0.014);
    canvas.disc(x, y, r * 1.5, scaled(colour, 0.7));
    canvas.disc(x, y, r, scaled(colour, 0.45));
  }
  canvas.modulate(fractal_noise(kSide, kSide, 8, 256, 1, random.next()), 0.05);
  return canvas.image();
}

cv::Mat parquet_texture(const Paint& colour, std::uint64_t seed) {
  constexpr int kSide = 1024, kRows = 12;
  Random random(seed);
  Canvas canvas(kSide, kSide, colour);
  for (int row = 0; row < kRows; ++row) {
    const double y = static_cast<double>(row) / kRows;
    double x = 0;
    while (x < 1) {
      double length = random.uniform(0.22, 0.45);
      if (x + length > 0.85) length = 1 - x;
      Canvas board(canvas, x, y, length, 1.0 / kRows);
      board.fill(scaled(mixed(colour, {120, 70, 35}, random.uniform(0, 0.5)), random.uniform(0.75, 1.12)));
      board.modulate(fractal_noise(board.width(), board.height(), 3, 16, 3, random.next()), 0.2);
      board.line(0, 0, 0, 1, scaled(colour, 0.35), 2);
      board.line(0, 0, 1, 0, scaled(colour, 0.4), 1);
      x += length;
    }
  }
  canvas.modulate(fractal_noise(kSide, kSide, 6, 6, 4, random.next()), 0.06);
  for (int i = 0; i < 25; ++i) {  // scratches
    const double sx = random.uniform(), sy = random.uniform(), a = random.uniform(0, 6.28);
    const double l = random.uniform(0.005, 0.03);
    canvas.line(sx, sy, sx + l * std::cos(a), sy + l * std::sin(a), scaled(colour, random.uniform(0.5, 1.3)),
                1);
  }
  return canvas.image();
}

cv::Mat plaster_texture(const Paint& colour, std::uint64_t seed) {
  constexpr int kSide = 512;
  Random random(seed);
  Canvas canvas(kSide, kSide, colour);
  canvas.modulate(fractal_noise(kSide, kSide, 3, 3, 4, random.next()), 0.035);
  canvas.modulate(fractal_noise(kSide, kSide, 64, 64, 3, random.next()), 0.05);
  for (int i = 0; i < 14; ++i) {  // marks that a wall gets
    const double x = random.uniform(), y = random.uniform(), a = random.uniform(0, 6.28);
    const double l = random.uniform(0.004, 0.03);
    canvas.line(x, y, x + l * std::cos(a), y + l * std::sin(a), scaled(colour, random.uniform(0.55, 0.85)),
                1);
  }
  canvas.grain(2, random);
  return canvas.image();
}

cv::Mat brick_texture(const Paint& colour, std::uint64_t seed) {
  constexpr int kSide = 1024, kRows = 16, kColumns = 5;
  Random random(seed);
  Canvas canvas(kSide, kSide, {168, 160, 150});
  canvas.modulate(fractal_noise(kSide, kSide, 96, 96, 2, random.next()), 0.15);
  for (int row = 0; row < kRows; ++row) {
    const double y = static_cast<double>(row) / kRows, shift = row % 2 == 0 ? 0 : 0.5 / kColumns;
    for (int c = 0; c < kColumns + (row % 2); ++c) {
      const double x0 = static_cast<double>(c) / kColumns - shift, gap = 0.006;
      const double left = std::max(0.0, x0 + gap), right = std::min(1.0, x0 + 1.0 / kColumns - gap);
      Canvas brick(canvas, left, y + gap, right - left, 1.0 / kRows - 2 * gap);
      const Paint base = mixed(colour, {90, 50, 45}, random.uniform(0, 0.6));
      brick.fill(scaled(base, random.uniform(0.75, 1.15)));
      brick.modulate(fractal_noise(brick.width(), brick.height(), 8, 4, 4, random.next()), 0.3);
      brick.line(0, 1, 1, 1, scaled(base, 0.55), 3);
      brick.line(0, 0, 1, 0, scaled(base, 1.25), 1);
    }
  }
  canvas.grain(5, random);
  return canvas.image();
}

cv::Mat checker_texture(const Paint& a, const Paint& b, std::uint64_t seed) {
  constexpr int kSide = 512, kTiles = 4;
  Random random(seed);
  Canvas canvas(kSide, kSide, {70, 68, 66});
  for (int row = 0; row < kTiles; ++row) {
    for (int c = 0; c < kTiles; ++c) {
      const double size = 1.0 / kTiles, joint = 0.004;
      Canvas tile(canvas, c * size + joint, row * size + joint, size - 2 * joint, size - 2 * joint);
      tile.fill(scaled((row + c) % 2 == 0 ? a : b, random.uniform(0.93, 1.05)));
      tile.modulate(fractal_noise(tile.width(), tile.height(), 3, 3, 5, random.next()), 0.14);
    }
  }
  canvas.grain(3, random);
  return canvas.image();
}

cv::Mat rug_texture(const Paint& ground, std::uint64_t seed) {
  constexpr int kSide = 512;
  Random random(seed);
  Canvas canvas(kSide, kSide, scaled(ground, 0.5));
  const Paint light{214, 190, 150}, dark = scaled(ground, 0.35),
                                    accent = hue_paint(random.uniform(), 0.6, 0.55);
  canvas.rectangle(0.04, 0.04, 0.92, 0.92, light);
  canvas.rectangle(0.055, 0.055, 0.89, 0.89, accent);
  for (int i = 0; i < 18; ++i) {  // border of lozenges
    const double at = 0.09 + i * 0.048;
    for (const auto& [x, y] : {std::pair{at, 0.095}, {at, 0.905}, {0.095, at}, {0.905, at}}) {
      canvas.triangle({x - 0.02, y}, {x, y - 0.02}, {x + 0.02, y}, light);
      canvas.triangle({x - 0.02, y}, {x, y + 0.02}, {x + 0.02, y}, dark);
    }
  }
  canvas.rectangle(0.14, 0.14, 0.72, 0.72, ground);
  canvas.frame(0.14, 0.14, 0.72, 0.72, light, 3);
  for (int i = 0; i < 90; ++i) {  // scattered flowers, in four-fold symmetry
    const double x = random.uniform(0.02, 0.34), y = random.uniform(0.02, 0.34),
                 r = random.uniform(0.005, 0.016);
    const Paint p = random.uniform() < 0.5 ? light : (random.uniform() < 0.5 ? accent : dark);
    for (int k = 0; k < 4; ++k) {
      const double cx = 0.5 + (k % 2 == 0 ? x : -x), cy = 0.5 + (k < 2 ? y : -y);
      canvas.disc(cx, cy, r, p);
      canvas.disc(cx, cy, r * 0.4, dark);
    }
  }
  for (int i = 6; i > 0; --i) canvas.disc(0.5, 0.5, 0.022 * i, i % 2 == 0 ? light : accent);
  canvas.modulate(fractal_noise(kSide, kSide, 256, 64, 1, random.next()), 0.14);
  canvas.grain(9, random);
  return canvas.image();
}

cv::Mat fabric_texture(const Paint& colour, std::uint64_t seed) {
  constexpr int kSide = 256;
  Random random(seed);
  Canvas canvas(kSide, kSide, colour);
  cv::Mat weave(kSide, kSide, CV_32FC1);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) weave.at<float>(y, x) = ((x / 4 + y / 4) % 2 == 0 ? 0.5F : -0.5F);
  }
  canvas.modulate(weave, 0.16);
  canvas.modulate(fractal_noise(kSide, kSide, 4, 4, 5, random.next()), 0.18);
  canvas.grain(7, random);
  return canvas.image();
}

cv::Mat ceiling_texture(std::uint64_t seed) {
  constexpr int kSide = 512;
  Random random(seed);
  Canvas canvas(kSide, kSide, {226, 226, 222});
  for (int i = 0; i < 2600; ++i) {  // the worm holes of mineral fibre
    const double x = random.uniform(), y = random.uniform(), a = random.uniform(0, 6.28);
    const double l = random.uniform(0.001, 0.007);
    canvas.line(x, y, x + l * std::cos(a), y + l * std::sin(a),
                scaled({226, 226, 222}, random.uniform(0.55, 0.85)), 1);
  }
  for (const double at : {0.0, 0.5}) {
    canvas.rectangle(at, 0, 0.012, 1, {190, 190, 188});
    canvas.rectangle(0, at, 1, 0.012, {190, 190, 188});
  }
  return canvas.image();
}

cv::Mat cardboard_texture(std::uint64_t seed) {
  constexpr int kSide = 512;
  Random random(seed);
  const Paint brown{186, 146, 100};
  Canvas canvas(kSide, kSide, brown);
  canvas.modulate(fractal_noise(kSide, kSide, 128, 2, 2, random.next()), 0.05);
  canvas.modulate(fractal_noise(kSide, kSide, 5, 5, 4, random.next()), 0.08);
  canvas.rectangle(0.44, 0, 0.12, 1, {202, 170, 122});
  canvas.line(0.5, 0, 0.5, 1, scaled(brown, 0.5), 2);
  canvas.rectangle(0.06, 0.58, 0.3, 0.3, {235, 232, 224});
  canvas.paragraph(0.08, 0.6, 0.26, 0.14, 0.028, {40, 40, 40}, random);
  for (double x = 0.08; x < 0.33; x += random.uniform(0.008, 0.018)) {
    canvas.rectangle(x, 0.77, random.uniform(0.003, 0.009), 0.09, {25, 25, 25});
  }
  canvas.text(pseudo_title(random, 1), 0.6, 0.3, 0.07, scaled(brown, 0.4), 3);
  canvas.triangle({0.66, 0.62}, {0.72, 0.5}, {0.78, 0.62}, scaled(brown, 0.35));
  canvas.rectangle(0.7, 0.62, 0.04, 0.1, scaled(brown, 0.35));
  canvas.frame(0.62, 0.46, 0.28, 0.3, scaled(brown, 0.35), 3);
  canvas.line(0, 0.0, 1, 0.0, scaled(brown, 0.6), 3);
  return canvas.image();
}

cv::Mat plain_texture(const Paint& colour, std::uint64_t seed) {
  constexpr int kSide = 128;
  Random random(seed);
  Canvas canvas(kSide, kSide, colour);
  canvas.modulate(fractal_noise(kSide, kSide, 4, 4, 4, random.next()), 0.06);
  canvas.grain(1.5, random);
  return canvas.image();
}

cv::Mat leaf_texture(std::uint64_t seed) {
  constexpr int kWidth = 64, kHeight = 256;
  Random random(seed);
  const Paint green{58, 112, 44};
  Canvas canvas(kWidth, kHeight, green);
  canvas.modulate(fractal_noise(kWidth, kHeight, 3, 8, 3, random.next()), 0.25);
  for (int i = 0; i < 14; ++i) {
    const double y = 0.05 + i * 0.07;
    canvas.line(0.5, y, 0.02, y - 0.05, {112, 156, 80}, 1);
    canvas.line(0.5, y, 0.98, y - 0.05, {112, 156, 80}, 1);
  }
  canvas.line(0.5, 0, 0.5, 1, {140, 178, 104}, 2);
  return canvas.image();
}

cv::Mat cork_texture(std::uint64_t seed) {
  constexpr int kSide = 512;
  Random random(seed);
  Canvas canvas(kSide, kSide, {176, 126, 78});
  canvas.modulate(fractal_noise(kSide, kSide, 48, 48, 3, random.next()), 0.35);
  canvas.grain(10, random);
  return canvas.image();
}

}  // namespace stdc::simulation
