#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>

#include "core/random.hpp"

namespace stdc::simulation {

/// Colour of paint: 8-bit sRGB red, green, blue.
struct Paint {
  int red = 0, green = 0, blue = 0;
};

/// `paint` lightened (factor > 1) or darkened, clipped.
Paint scaled(const Paint& paint, double factor);
Paint mixed(const Paint& a, const Paint& b, double share_of_b);
/// A saturated colour; hue in [0, 1).
Paint hue_paint(double hue, double saturation, double value);

/// Noise that tiles, CV_32FC1 in about [-1, 1]: `octaves` layers of value noise (Perlin's fractal sum), the
/// first with cells_x x cells_y lattice cells.
cv::Mat fractal_noise(int width, int height, int cells_x, int cells_y, int octaves, std::uint64_t seed);

/// A bitmap to paint textures on; lengths and positions are fractions of its width and height.
class Canvas {
 public:
  Canvas(int width, int height, const Paint& ground);
  /// A canvas within another: painting on it paints on `parent`.
  Canvas(Canvas& parent, double x, double y, double width, double height);

  int width() const { return image_.cols; }
  int height() const { return image_.rows; }
  cv::Mat& image() { return image_; }

  void fill(const Paint& paint);
  void rectangle(double x, double y, double width, double height, const Paint& paint);
  void frame(double x, double y, double width, double height, const Paint& paint, int pixels);
  /// Radius as a fraction of the width.
  void disc(double x, double y, double radius, const Paint& paint);
  void ring(double x, double y, double radius, const Paint& paint, int pixels);
  void line(double x0, double y0, double x1, double y1, const Paint& paint, int pixels);
  void triangle(const cv::Point2d& a, const cv::Point2d& b, const cv::Point2d& c, const Paint& paint);
  /// One line of text; `height` is that of its capitals, as a fraction of the canvas's height; narrowed if it
  /// would not fit.
  void text(std::string_view words, double x, double y, double height, const Paint& paint, int pixels = 1);
  /// Lines of pseudo words filling a rectangle.
  void paragraph(double x, double y, double width, double height, double line_height, const Paint& paint,
                 Random& random);
  /// Vertical blend from `top` to `bottom`.
  void gradient(const Paint& top, const Paint& bottom);
  /// Multiplies every pixel by 1 + strength * noise; noise is CV_32FC1 of the canvas's size.
  void modulate(const cv::Mat& noise, double strength);
  /// Independent noise of each pixel, in 8-bit steps (standard deviation).
  void grain(double sigma, Random& random);

 private:
  cv::Point point(double x, double y) const;

  cv::Mat image_;
};

/// A pseudo word of 2..9 letters.
std::string pseudo_word(Random& random);
std::string pseudo_title(Random& random, int words);

}  // namespace stdc::simulation
