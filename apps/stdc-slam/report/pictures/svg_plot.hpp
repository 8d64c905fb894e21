#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace stdc::app {

/// Where a plot's data lie in the drawing [px].
struct SvgArea {
  double left = 0, top = 0, width = 0, height = 0;
};

/// What a plot must show.
struct SvgAxes {
  Eigen::Vector2d low, high;  ///< corners, in the units of the data
  std::string x_label, y_label;
  bool equal = false;  ///< both axes to the same scale; then more is shown along one of them
};

/// A plot with axes, grid and legend, as a part of an SVG drawing. The same calls give the same bytes.
class SvgPlot {
 public:
  SvgPlot(const SvgArea& area, const SvgAxes& axes);

  /// Lines through points; broken where one is not finite. Colours: "#0072b2".
  void line(const std::vector<Eigen::Vector2d>& points, double width, const std::string& colour);
  void dots(const std::vector<Eigen::Vector2d>& points, double radius, const std::string& colour);
  /// An entry of the legend above the plot, from the left.
  void legend(const std::string& text, const std::string& colour, bool as_dot = false);
  /// Colours from `low` to `high`, to the right of the plot.
  void colour_bar(const std::vector<std::string>& colours, const std::string& low, const std::string& high);

  std::string svg() const;

 private:
  Eigen::Vector2d to_pixel(const Eigen::Vector2d& point) const;
  void draw_axis(int axis, const std::string& label);

  SvgArea area_;
  Eigen::Vector2d low_, high_;
  double legend_x_;
  std::string axes_, data_, marks_;
};

/// A drawing of several plots with a title.
std::string svg_drawing(double width, double height, const std::string& title,
                        const std::vector<SvgPlot>& plots);

/// Viridis from dark to light, in `count` steps: told apart by everybody, and in grey.
std::vector<std::string> viridis(int count);

}  // namespace stdc::app
