#include "simulation/people/person_textures.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "simulation/scene/surface_textures.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3f;

constexpr float kClothTile = 0.4F;                      // side of a cloth texture [m]
constexpr float kHeadLow = 1.45F, kHeadSpan = 0.34F;    // heights that head and hair textures region [m]
constexpr float kHeadMiddle = 0.018F;                   // y of the axis that they go round
constexpr float kPrintLow = 1.14F, kPrintSide = 0.26F;  // the picture on the chest [m]

/// Positions on the head texture: x across the face, z up, as in head_shape.cpp [m].
double face_u(double x) { return 0.5 + std::atan2(x, 0.112) / (2 * std::numbers::pi); }
double face_v(double z) { return (kHeadLow + kHeadSpan - z) / kHeadSpan; }

struct Complexion {
  Paint skin, hair;
};

/// Fair hair goes with fair skin, dark hair with any.
Complexion draw_complexion(Random& random) {
  static constexpr std::array<Paint, 5> kSkins{
      Paint{232, 190, 165}, {219, 170, 138}, {200, 148, 112}, {164, 112, 80}, {120, 80, 56}};
  static constexpr std::array<Paint, 5> kHairs{
      Paint{38, 28, 22}, {60, 42, 30}, {104, 74, 46}, {168, 130, 80}, {124, 120, 116}};
  const std::uint32_t tone = random.below(kSkins.size());
  const std::uint32_t shades = tone < 2 ? 5 : (tone == 2 ? 3 : 1);
  const Paint skin = scaled(kSkins[tone], random.uniform(0.95, 1.05));
  return {skin, scaled(kHairs[random.below(shades)], random.uniform(0.85, 1.15))};
}

cv::Mat skin_texture(const Paint& skin, Random& random) {
  Canvas canvas(256, 256, skin);
  canvas.modulate(fractal_noise(256, 256, 4, 4, 5, random.next()), 0.05);
  canvas.grain(2, random);
  return canvas.image();
}

void paint_eye(Canvas& c, double side, const Paint& skin, const Paint& iris) {
  const double x = side * 0.031, z = 1.6395;
  for (double dx = -0.0145; dx <= 0.0145; dx += 0.0004) {  // an almond, column by column
    const double open = 0.0052 * std::sqrt(std::max(0.0, 1 - std::pow(dx / 0.0145, 2)));
    c.line(face_u(x + dx), face_v(z + open), face_u(x + dx), face_v(z - 0.8 * open), {236, 232, 226}, 1);
    c.line(face_u(x + dx), face_v(z + open + 0.0016), face_u(x + dx), face_v(z + open), {48, 34, 28}, 1);
  }
  const double pixel = 1.0 / (2 * std::numbers::pi * 0.112);  // of a metre, as a fraction of the width
  c.disc(face_u(x), face_v(z + 0.0004), 0.0052 * pixel, iris);
  c.disc(face_u(x), face_v(z + 0.0004), 0.0024 * pixel, {12, 10, 10});
  c.disc(face_u(x + 0.0018), face_v(z + 0.002), 0.0009 * pixel, {250, 250, 250});
  c.line(face_u(x - 0.012), face_v(z - 0.0075), face_u(x + 0.012), face_v(z - 0.0075), scaled(skin, 0.86), 1);
}

cv::Mat head_texture(const PersonAppearance& appearance, const Paint& skin, const Paint& hair,
                     Random& random) {
  Canvas c(1024, 512, skin);
  c.modulate(fractal_noise(1024, 512, 12, 6, 5, random.next()), 0.05);
  const bool beard = appearance.measures.chest_depth == 0 && random.below(2) == 0;
  cv::Mat shade(512, 1024, CV_32FC1);
  for (int y = 0; y < 512; ++y) {  // blush of the cheeks, shadow of a beard
    for (int x = 0; x < 1024; ++x) {
      const double across = std::tan((x / 1024.0 - 0.5) * 2 * std::numbers::pi) * 0.112;
      const bool front = std::abs(x - 512) < 230;
      const double z = kHeadLow + kHeadSpan * (1 - y / 512.0);
      const double below = 1 / (1 + std::exp((z - 1.592) / 0.006)) * (1 / (1 + std::exp((1.53 - z) / 0.006)));
      const double lips = std::exp(-(across * across / 0.0007 + (z - 1.572) * (z - 1.572) / 0.0001));
      shade.at<float>(y, x) = static_cast<float>(front && beard ? -0.35 * below * (1 - lips) : 0);
    }
  }
  c.modulate(shade, 1);
  const Paint brow = mixed(hair, {40, 30, 24}, 0.4),
              lip = mixed(skin, {176, 70, 74}, appearance.measures.chest_depth > 0 ? 0.75 : 0.4);
  for (const double side : {-1.0, 1.0}) {
    paint_eye(c, side, skin, hue_paint(random.uniform(0.05, 0.6), 0.4, 0.4));
    for (int i = 0; i < 40; ++i) {  // hairs of the brow
      const double t = i / 39.0, x = side * (0.012 + 0.038 * t),
                   z = 1.6585 + 0.006 * std::sin(2.2 * t) - 0.003 * t;
      c.line(face_u(x), face_v(z - 0.002), face_u(x + side * 0.004), face_v(z + 0.0022), brow, 2);
    }
    c.disc(face_u(side * 0.0065), face_v(1.5975), 0.004, scaled(skin, 0.35));  // nostrils
  }
  for (double x = -0.023; x <= 0.023; x += 0.0004) {
    const double half = 0.0075 * (1 - std::pow(std::abs(x) / 0.0235, 1.7));
    c.line(face_u(x), face_v(1.5735 + 0.8 * half), face_u(x), face_v(1.5735 - half), lip, 1);
  }
  c.line(face_u(-0.022), face_v(1.5735), face_u(0.022), face_v(1.5735), scaled(lip, 0.5), 2);
  c.grain(2, random);
  return c.image();
}

cv::Mat hair_texture(const Paint& hair, Random& random) {
  Canvas c(512, 256, hair);
  c.modulate(fractal_noise(512, 256, 128, 3, 2, random.next()), 0.35);
  c.modulate(fractal_noise(512, 256, 16, 4, 2, random.next()), 0.2);
  return c.image();
}

cv::Mat plaid(const Paint& a, const Paint& b, Random& random) {
  Canvas c(256, 256, a);
  for (int i = 0; i < 6; ++i) {
    const double at = i / 6.0;
    c.rectangle(at, 0, 0.06, 1, mixed(a, b, 0.5));
    c.rectangle(0, at, 1, 0.06, mixed(a, b, 0.5));
    for (int k = 0; k < 6; ++k) c.rectangle(at, k / 6.0, 0.06, 0.06, b);
    c.line(at + 0.11, 0, at + 0.11, 1, {235, 230, 220}, 1);
    c.line(0, at + 0.11, 1, at + 0.11, {235, 230, 220}, 1);
  }
  c.grain(4, random);
  return c.image();
}

cv::Mat stripes(const Paint& a, const Paint& b, Random& random) {
  Canvas c(256, 256, a);
  for (int i = 0; i < 10; ++i) c.rectangle(0, i / 10.0, 1, 0.045, b);
  c.grain(4, random);
  return c.image();
}

/// Plain cloth with the small unevenness of yarn.
cv::Mat jersey(const Paint& a, Random& random) {
  Canvas c(256, 256, a);
  c.modulate(fractal_noise(256, 256, 5, 5, 4, random.next()), 0.12);
  c.modulate(fractal_noise(256, 256, 128, 32, 1, random.next()), 0.08);
  c.grain(4, random);
  return c.image();
}

cv::Mat top_texture(Random& random, bool* is_plain) {
  *is_plain = false;
  const Paint a = hue_paint(random.uniform(), random.uniform(0.2, 0.7), random.uniform(0.3, 0.85));
  const Paint b = hue_paint(random.uniform(), random.uniform(0.3, 0.7), random.uniform(0.2, 0.6));
  switch (random.below(4)) {
    case 0:
      return plaid(a, b, random);
    case 1:
      return stripes(a, b, random);
    default:
      *is_plain = true;
      return jersey(a, random);
  }
}

cv::Mat trousers_texture(Random& random) {
  static constexpr std::array<Paint, 4> kCloths{
      Paint{52, 66, 98}, {44, 44, 50}, {136, 120, 94}, {76, 84, 70}};
  Canvas c(256, 256, kCloths[random.below(kCloths.size())]);
  c.modulate(fractal_noise(256, 256, 5, 2, 4, random.next()), 0.22);
  c.modulate(fractal_noise(256, 256, 128, 16, 1, random.next()), 0.12);
  c.grain(6, random);
  return c.image();
}

cv::Mat print_texture(const cv::Mat& cloth, Random& random) {
  Canvas c(256, 256, {0, 0, 0});
  cloth.copyTo(c.image());
  const Paint ink = hue_paint(random.uniform(), 0.7, 0.9);
  c.ring(0.5, 0.42, 0.3, ink, 12);
  for (int i = 0; i < 6; ++i) {
    const double a = random.uniform(0, 6.28), r = random.uniform(0.05, 0.22);
    c.triangle({0.5 + r * std::cos(a), 0.42 + r * std::sin(a)},
               {0.5 + r * std::cos(a + 1.5), 0.42 + r * std::sin(a + 1.5)},
               {0.5 + 0.1 * std::cos(a + 3), 0.42 + 0.1 * std::sin(a + 3)},
               hue_paint(random.uniform(), 0.6, 0.9));
  }
  c.text(pseudo_title(random, 1), 0.12, 0.92, 0.11, ink, 3);
  return c.image();
}

}  // namespace

PersonTextures::PersonTextures(const PersonAppearance& appearance)
    : height_(static_cast<float>(appearance.measures.height)) {
  Random random(appearance.seed, 41);
  const auto [skin, hair] = draw_complexion(random);
  bool plain = false;
  const cv::Mat top = top_texture(random, &plain);
  const Paint shoe = random.below(2) == 0 ? Paint{40, 36, 34} : hue_paint(random.uniform(), 0.5, 0.5);
  textures_.emplace_back(skin_texture(skin, random));
  textures_.emplace_back(head_texture(appearance, skin, hair, random));
  textures_.emplace_back(hair_texture(hair, random));
  textures_.emplace_back(top);
  textures_.emplace_back(trousers_texture(random));
  textures_.emplace_back(plain_texture(shoe, random.next()));
  textures_.emplace_back(plain_texture({205, 202, 196}, random.next()));
  if (plain && random.below(3) != 0) print_.emplace_back(print_texture(top, random));
}

Rgb PersonTextures::round(const Texture& texture, const Vector3f& at_rest, float seen) const {
  const float scale = 0.5F * (1 + height_ / 1.75F), z = (at_rest.z() - height_) / scale + 1.75F;
  const float u =
      0.5F + std::atan2(at_rest.x(), kHeadMiddle * scale - at_rest.y()) / (2 * std::numbers::pi_v<float>);
  return texture.sample(u, (kHeadLow + kHeadSpan - z) / kHeadSpan,
                        seen * static_cast<float>(texture.height()) / kHeadSpan);
}

Rgb PersonTextures::colour(BodyRegion region, const Vector3f& p, const Vector3f& n, float seen) const {
  const Texture& texture = textures_[static_cast<std::size_t>(region)];
  if (region == BodyRegion::head || region == BodyRegion::hair) return round(texture, p, seen);
  if (region == BodyRegion::top && !print_.empty() && n.y() < -0.3F) {
    const float low = kPrintLow * height_ / 1.75F, u = p.x() / kPrintSide + 0.5F,
                v = 1 - (p.z() - low) / kPrintSide;
    if (u > 0 && u < 1 && v > 0 && v < 1)
      return print_[0].sample(u, v, seen * static_cast<float>(print_[0].width()) / kPrintSide);
  }
  const float texels = seen * static_cast<float>(texture.width()) / kClothTile;
  // From the front and from the side, blended where the surface turns; from above only where it is flat.
  const Vector3f w = n.cwiseAbs2().cwiseAbs2();
  Rgb sum = Rgb::Zero();
  float total = 0;
  const std::array<std::array<float, 2>, 3> places{{{p.y(), -p.z()}, {p.x(), -p.z()}, {p.x(), p.y()}}};
  for (int axis = 0; axis < 3; ++axis) {
    if (w[axis] < 0.03F) continue;
    sum += w[axis] * texture.sample(places[axis][0] / kClothTile, places[axis][1] / kClothTile, texels);
    total += w[axis];
  }
  return sum / total;
}

}  // namespace stdc::simulation
