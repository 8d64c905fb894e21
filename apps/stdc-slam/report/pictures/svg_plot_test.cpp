#include "report/pictures/svg_plot.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace stdc::app {
namespace {

std::string some_drawing(const std::string& title) {
  SvgPlot plot({80, 60, 400, 200}, {{0, 0}, {1, 2}, "x [m]", "y [m]", true});
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  plot.line({{0, 0}, {0.5, 1}, {kNaN, kNaN}, {0.6, 1}, {1, 2}}, 2, "#0072b2");
  plot.dots({{0.5, 1e300}, {0.1, 0.1}}, 3, "#d55e00");
  plot.legend("a < b & \"c\"", "#0072b2");
  plot.colour_bar(viridis(8), "0", "1");
  return svg_drawing(600, 320, title, {plot});
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(SvgPlot, IsWellFormedWhateverTheText) {
  const std::string svg = some_drawing("</svg><script> \xff caf\xc3\xa9 \x01");
  EXPECT_EQ(svg, some_drawing("</svg><script> \xff caf\xc3\xa9 \x01"));
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  EXPECT_NE(svg.find("caf\xc3\xa9 ?"), std::string::npos);
  EXPECT_NE(svg.find("a &lt; b &amp; \"c\""), std::string::npos);
  EXPECT_EQ(count(svg, "<svg"), count(svg, "</svg>"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(SvgPlot, EqualAxesShowMoreOfOne) {
  const std::string svg = some_drawing("t");
  // 2 m in 200 px: 4 m in 400 px, from -1.5 to 2.5.
  EXPECT_NE(svg.find(">-1<"), std::string::npos);
  EXPECT_NE(svg.find(">2<"), std::string::npos);
}

TEST(SvgPlot, LinesBreakWhereThereIsNothing) {
  const std::string svg = some_drawing("t");
  const std::size_t line = svg.find("stroke=\"#0072b2\" stroke-width=\"2\"");
  const std::size_t start = svg.rfind("<path", line);
  EXPECT_EQ(count(svg.substr(start, line - start), "M"), 2U);
}

TEST(Viridis, GoesFromDarkToLight) {
  EXPECT_EQ(viridis(9).front(), "#440154");
  EXPECT_EQ(viridis(9).back(), "#fde725");
  EXPECT_EQ(viridis(1).size(), 1U);
}

}  // namespace
}  // namespace stdc::app
