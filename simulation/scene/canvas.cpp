#include "simulation/scene/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace stdc::simulation {
namespace {

cv::Scalar bgr(const Paint& p) {
  return {static_cast<double>(p.blue), static_cast<double>(p.green), static_cast<double>(p.red)};
}

int clip(double value) { return static_cast<int>(std::clamp(value, 0.0, 255.0)); }

/// Adds one layer of value noise with a smooth (cubic) blend between the lattice points.
void add_octave(cv::Mat& sum, int cells_x, int cells_y, float amplitude, Random& random) {
  std::vector<float> lattice(static_cast<std::size_t>(cells_x) * cells_y);
  for (float& value : lattice) value = static_cast<float>(random.uniform(-1, 1));
  std::vector<int> left(sum.cols), right(sum.cols);
  std::vector<float> weight(sum.cols);
  const auto split = [](int at, int size, int cells, int* low, int* high) {
    const float position =
        (static_cast<float>(at) + 0.5F) * static_cast<float>(cells) / static_cast<float>(size);
    *low = static_cast<int>(position) % cells;
    *high = (*low + 1) % cells;
    const float f = position - std::floor(position);
    return f * f * (3 - 2 * f);
  };
  for (int x = 0; x < sum.cols; ++x) weight[x] = split(x, sum.cols, cells_x, &left[x], &right[x]);
  for (int y = 0; y < sum.rows; ++y) {
    int low = 0, high = 0;
    const float w = split(y, sum.rows, cells_y, &low, &high);
    const float* a = lattice.data() + static_cast<std::size_t>(low) * cells_x;
    const float* b = lattice.data() + static_cast<std::size_t>(high) * cells_x;
    auto* row = sum.ptr<float>(y);
    for (int x = 0; x < sum.cols; ++x) {
      const float top = a[left[x]] + weight[x] * (a[right[x]] - a[left[x]]);
      const float bottom = b[left[x]] + weight[x] * (b[right[x]] - b[left[x]]);
      row[x] += amplitude * (top + w * (bottom - top));
    }
  }
}

}  // namespace

Paint scaled(const Paint& paint, double factor) {
  return {clip(paint.red * factor), clip(paint.green * factor), clip(paint.blue * factor)};
}

Paint mixed(const Paint& a, const Paint& b, double share_of_b) {
  const auto mix = [&](int x, int y) { return clip(x + (y - x) * share_of_b); };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

Paint hue_paint(double hue, double saturation, double value) {
  const auto channel = [&](double shift) {
    const double h = hue + shift, ramp = std::abs((h - std::floor(h)) * 6 - 3) - 1;
    return clip(255 * value * (1 + saturation * (std::clamp(ramp, 0.0, 1.0) - 1)));
  };
  return {channel(0), channel(2.0 / 3), channel(1.0 / 3)};
}

cv::Mat fractal_noise(int width, int height, int cells_x, int cells_y, int octaves, std::uint64_t seed) {
  cv::Mat sum = cv::Mat::zeros(height, width, CV_32FC1);
  Random random(seed);
  float amplitude = 1, total = 0;
  for (int i = 0; i < octaves && cells_x <= width && cells_y <= height; ++i) {
    add_octave(sum, cells_x, cells_y, amplitude, random);
    total += amplitude;
    amplitude *= 0.55F;
    cells_x *= 2;
    cells_y *= 2;
  }
  sum *= 1.6F / total;
  return sum;
}

Canvas::Canvas(int width, int height, const Paint& ground) : image_(height, width, CV_8UC3, bgr(ground)) {}

Canvas::Canvas(Canvas& parent, double x, double y, double width, double height) {
  const cv::Point low = parent.point(x, y), high = parent.point(x + width, y + height);
  const cv::Rect whole(0, 0, parent.width(), parent.height());
  image_ = parent.image_(cv::Rect(low, cv::Size(std::max(1, high.x - low.x), std::max(1, high.y - low.y))) &
                         whole);
}

cv::Point Canvas::point(double x, double y) const {
  return {static_cast<int>(std::lround(x * image_.cols)), static_cast<int>(std::lround(y * image_.rows))};
}

void Canvas::fill(const Paint& paint) { image_.setTo(bgr(paint)); }

void Canvas::rectangle(double x, double y, double width, double height, const Paint& paint) {
  const cv::Point low = point(x, y), high = point(x + width, y + height);
  if (high.x <= low.x || high.y <= low.y) return;
  cv::rectangle(image_, low, high - cv::Point(1, 1), bgr(paint), cv::FILLED);
}

void Canvas::frame(double x, double y, double width, double height, const Paint& paint, int pixels) {
  cv::rectangle(image_, point(x, y), point(x + width, y + height) - cv::Point(1, 1), bgr(paint), pixels);
}

void Canvas::disc(double x, double y, double radius, const Paint& paint) {
  cv::circle(image_, point(x, y), static_cast<int>(std::lround(radius * width())), bgr(paint), cv::FILLED,
             cv::LINE_AA);
}

void Canvas::ring(double x, double y, double radius, const Paint& paint, int pixels) {
  cv::circle(image_, point(x, y), static_cast<int>(std::lround(radius * width())), bgr(paint), pixels,
             cv::LINE_AA);
}

void Canvas::line(double x0, double y0, double x1, double y1, const Paint& paint, int pixels) {
  cv::line(image_, point(x0, y0), point(x1, y1), bgr(paint), pixels, cv::LINE_AA);
}

void Canvas::triangle(const cv::Point2d& a, const cv::Point2d& b, const cv::Point2d& c, const Paint& paint) {
  const std::array corners{point(a.x, a.y), point(b.x, b.y), point(c.x, c.y)};
  cv::fillConvexPoly(image_, corners.data(), 3, bgr(paint), cv::LINE_AA);
}

void Canvas::text(std::string_view words, double x, double y, double height, const Paint& paint, int pixels) {
  constexpr double kCapitalPixels = 21;  // of the Hershey fonts at scale 1
  double scale = height * this->height() / kCapitalPixels;
  const std::string line(words);
  int baseline = 0;
  const cv::Size size = cv::getTextSize(line, cv::FONT_HERSHEY_DUPLEX, scale, pixels, &baseline);
  const double room = (1 - x) * width();
  if (size.width > room && room > 0) scale *= room / size.width;
  cv::putText(image_, line, point(x, y), cv::FONT_HERSHEY_DUPLEX, scale, bgr(paint), pixels, cv::LINE_AA);
}

void Canvas::paragraph(double x, double y, double width, double height, double line_height,
                       const Paint& paint, Random& random) {
  const double letter = 0.42 * line_height * this->height() / this->width();
  for (double baseline = y + line_height; baseline <= y + height; baseline += line_height) {
    const bool short_line = random.uniform() < 0.15;
    const double end = x + (short_line ? random.uniform(0.3, 0.8) : random.uniform(0.93, 1)) * width;
    for (double at = x; at < end;) {
      const double length = letter * random.uniform(2, 9);
      const double word_end = std::min(at + length, end);
      const bool ascender = random.uniform() < 0.6;
      rectangle(at, baseline - 0.42 * line_height, word_end - at, 0.42 * line_height, paint);
      if (ascender) {  // a letter that sticks out, so that words differ
        rectangle(at + letter * random.uniform(0, 1.5), baseline - 0.66 * line_height, letter * 0.5,
                  0.3 * line_height, paint);
      }
      at = word_end + letter * random.uniform(0.7, 1.1);
    }
  }
}

void Canvas::gradient(const Paint& top, const Paint& bottom) {
  for (int y = 0; y < image_.rows; ++y) {
    image_.row(y).setTo(bgr(mixed(top, bottom, static_cast<double>(y) / std::max(1, image_.rows - 1))));
  }
}

void Canvas::modulate(const cv::Mat& noise, double strength) {
  for (int y = 0; y < image_.rows; ++y) {
    auto* row = image_.ptr<cv::Vec3b>(y);
    const auto* values = noise.ptr<float>(y);
    for (int x = 0; x < image_.cols; ++x) {
      const float factor = 1 + static_cast<float>(strength) * values[x];
      for (int c = 0; c < 3; ++c) {
        row[x][c] = static_cast<std::uint8_t>(
            std::clamp(static_cast<float>(row[x][c]) * factor + 0.5F, 0.0F, 255.0F));
      }
    }
  }
}

void Canvas::grain(double sigma, Random& random) {
  const auto amplitude = static_cast<float>(sigma * 1.7320508);  // uniform noise of this half width
  for (int y = 0; y < image_.rows; ++y) {
    auto* row = image_.ptr<cv::Vec3b>(y);
    for (int x = 0; x < image_.cols; ++x) {
      const float shift = amplitude * (static_cast<float>(random.next()) * (2.0F / 4294967296.0F) - 1.0F);
      for (int c = 0; c < 3; ++c) {
        row[x][c] =
            static_cast<std::uint8_t>(std::clamp(static_cast<float>(row[x][c]) + shift + 0.5F, 0.0F, 255.0F));
      }
    }
  }
}

std::string pseudo_word(Random& random) {
  static constexpr std::array kSyllables{"ra",  "to",  "mi", "ne",  "sol", "ver", "ka", "lin", "pro", "dis",
                                         "gra", "ter", "vo", "chi", "pla", "net", "or", "qua", "bel", "stu"};
  std::string word;
  const std::uint32_t count = 1 + random.below(3);
  for (std::uint32_t i = 0; i <= count; ++i) word += kSyllables[random.below(kSyllables.size())];
  return word;
}

std::string pseudo_title(Random& random, int words) {
  std::string title;
  for (int i = 0; i < words; ++i) {
    std::string word = pseudo_word(random);
    word[0] = static_cast<char>(word[0] - 'a' + 'A');
    title += (i == 0 ? "" : " ") + word;
  }
  return title;
}

}  // namespace stdc::simulation
