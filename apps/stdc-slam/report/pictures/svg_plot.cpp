#include "report/pictures/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/utf8.hpp"

namespace stdc::app {
namespace {

constexpr const char* kInk = "#1c2128";
constexpr const char* kSoft = "#57606a";
constexpr const char* kGrid = "#e3e6ea";
constexpr double kLetter = 6.6;  // width of one, about [px]

/// Text as XML has it: marks escaped, and '?' for what is no printable character.
std::string escaped(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t length = utf8_length(text, i);
    const char c = text[i];
    if (length == 0 || (length == 1 && static_cast<unsigned char>(c) < 0x20)) {
      result += '?';
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '&') {
      result += "&amp;";
    } else {
      result += text.substr(i, length);
      i += length - 1;
    }
  }
  return result;
}

std::string label(double x, double y, const char* anchor, double size, const char* colour,
                  const std::string& text, const std::string& more = "") {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{:g}\" fill=\"{}\"{}>{}</text>\n", x, y,
      anchor, size, colour, more, escaped(text));
}

/// The largest of 1, 2, 5 times a power of ten that gives four steps or more.
double tick_step(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 4)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= range / 4) return factor * power;
  }
  return power;
}

}  // namespace

SvgPlot::SvgPlot(const SvgArea& area, const SvgAxes& axes)
    : area_(area), low_(axes.low), high_(axes.high), legend_x_(area.left) {
  const Eigen::Vector2d extent = (high_ - low_).cwiseMax(1e-6);
  Eigen::Vector2d shown = extent;
  if (axes.equal) {
    const double unit = std::max(extent.x() / area.width, extent.y() / area.height);
    shown = {unit * area.width, unit * area.height};
  }
  const Eigen::Vector2d centre = 0.5 * (low_ + high_);
  low_ = centre - 0.5 * shown;
  high_ = centre + 0.5 * shown;
  draw_axis(0, axes.x_label);
  draw_axis(1, axes.y_label);
}

Eigen::Vector2d SvgPlot::to_pixel(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d share = (point - low_).cwiseQuotient(high_ - low_);
  // Far points stay outside; readers of SVG need not take all numbers.
  return {area_.left + std::clamp(share.x(), -50.0, 50.0) * area_.width,
          area_.top + (1 - std::clamp(share.y(), -50.0, 50.0)) * area_.height};
}

void SvgPlot::draw_axis(int axis, const std::string& name) {
  const double step = tick_step(high_[axis] - low_[axis]);
  const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  const double bottom = area_.top + area_.height, right = area_.left + area_.width;
  for (double k = std::ceil(low_[axis] / step - 1e-9); k * step <= high_[axis] + 1e-9 * step; ++k) {
    Eigen::Vector2d place = low_;
    place[axis] = k * step;
    const Eigen::Vector2d at = to_pixel(place);
    const std::string text = fmt::format("{:.{}f}", k == 0 ? 0.0 : k * step, digits);
    const Eigen::Vector2d end =
        axis == 0 ? Eigen::Vector2d(at.x(), area_.top) : Eigen::Vector2d(right, at.y());
    axes_ += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\"/>\n", at.x(), at.y(),
                         end.x(), end.y(), kGrid);
    axes_ += axis == 0 ? label(at.x(), bottom + 16, "middle", 11, kSoft, text)
                       : label(area_.left - 6, at.y() + 4, "end", 11, kSoft, text);
  }
  if (axis == 0) {
    axes_ += label(area_.left + area_.width / 2, bottom + 34, "middle", 12, kSoft, name);
  } else {
    const double x = area_.left - 46, y = area_.top + area_.height / 2;
    axes_ +=
        label(x, y, "middle", 12, kSoft, name, fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", x, y));
  }
}

void SvgPlot::line(const std::vector<Eigen::Vector2d>& points, double width, const std::string& colour) {
  std::string path;
  bool drawing = false;
  for (const Eigen::Vector2d& point : points) {
    if (!point.allFinite()) {
      drawing = false;
      continue;
    }
    const Eigen::Vector2d at = to_pixel(point);
    path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", at.x(), at.y());
    drawing = true;
  }
  if (path.empty()) return;
  data_ += fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\" stroke-linejoin=\"round\"/>\n", path,
      colour, width);
}

void SvgPlot::dots(const std::vector<Eigen::Vector2d>& points, double radius, const std::string& colour) {
  for (const Eigen::Vector2d& point : points) {
    if (!point.allFinite()) continue;
    const Eigen::Vector2d at = to_pixel(point);
    data_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" fill=\"{}\"/>\n", at.x(), at.y(),
                         radius, colour);
  }
}

void SvgPlot::legend(const std::string& text, const std::string& colour, bool as_dot) {
  const double y = area_.top - 10;
  marks_ += as_dot ? fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", legend_x_ + 9,
                                 y - 4, colour)
                   : fmt::format("<path d=\"M{:.1f} {:.1f}h18\" stroke=\"{}\" stroke-width=\"3\"/>\n",
                                 legend_x_, y - 4, colour);
  marks_ += label(legend_x_ + 23, y, "start", 12, kInk, text);
  legend_x_ += 40 + kLetter * static_cast<double>(text.size());
}

void SvgPlot::colour_bar(const std::vector<std::string>& colours, const std::string& low,
                         const std::string& high) {
  const double x = area_.left + area_.width + 12, step = area_.height / static_cast<double>(colours.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double y = area_.top + area_.height - step * static_cast<double>(i + 1);
    marks_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"10\" height=\"{:.1f}\" fill=\"{}\"/>\n", x,
                          y, step + 0.3, colours[i]);
  }
  marks_ += label(x + 14, area_.top + 10, "start", 11, kSoft, high) +
            label(x + 14, area_.top + area_.height, "start", 11, kSoft, low);
}

std::string SvgPlot::svg() const {
  const std::string box = fmt::format("x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"",
                                      area_.left, area_.top, area_.width, area_.height);
  // A view of its own cuts off what lies outside.
  return axes_ +
         fmt::format(
             "<svg {} viewBox=\"{:.1f} {:.1f} {:.1f} {:.1f}\">\n{}</svg>\n<rect {} fill=\"none\" "
             "stroke=\"#8b939c\"/>\n",
             box, area_.left, area_.top, area_.width, area_.height, data_, box) +
         marks_;
}

std::string svg_drawing(double width, double height, const std::string& title,
                        const std::vector<SvgPlot>& plots) {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" viewBox=\"0 0 {0:g} "
      "{1:g}\" "
      "font-family=\"DejaVu Sans, Liberation Sans, sans-serif\">\n<title>{2}</title>\n<rect width=\"100%\" "
      "height=\"100%\" fill=\"#ffffff\"/>\n",
      width, height, escaped(title));
  text += label(24, 30, "start", 16, kInk, title);
  for (const SvgPlot& plot : plots) text += plot.svg();
  return text + "</svg>\n";
}

std::vector<std::string> viridis(int count) {
  // Nine points of the map of matplotlib (van der Walt and Smith, 2015; public domain).
  constexpr std::array<std::array<double, 3>, 9> kPoints{{{68, 1, 84},
                                                          {71, 44, 122},
                                                          {59, 81, 139},
                                                          {44, 113, 142},
                                                          {33, 144, 141},
                                                          {39, 173, 129},
                                                          {92, 200, 99},
                                                          {170, 220, 50},
                                                          {253, 231, 37}}};
  std::vector<std::string> colours;
  for (int i = 0; i < count; ++i) {
    const double place = count > 1 ? 8.0 * i / (count - 1) : 0;
    const auto below = std::min<std::size_t>(7, static_cast<std::size_t>(place));
    const double share = place - static_cast<double>(below);
    std::string colour = "#";
    for (std::size_t k = 0; k < 3; ++k) {
      colour += fmt::format("{:02x}", static_cast<int>(std::lround((1 - share) * kPoints[below][k] +
                                                                   share * kPoints[below + 1][k])));
    }
    colours.push_back(colour);
  }
  return colours;
}

}  // namespace stdc::app
