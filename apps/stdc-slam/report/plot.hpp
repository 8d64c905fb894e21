#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace stdc::app {

/// A picture with two metric axes of the same scale, a grid and room for a legend at the right. Everything is
/// drawn at twice its size and reduced at the end, which makes lines and letters smooth. Colours are BGR.
class Plot {
 public:
  /// `low`, `high`: corners of what must be visible [m]; the rest of the drawing area is filled around it.
  Plot(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const std::string& title,
       const std::string& x_label, const std::string& y_label);

  void dot(const Eigen::Vector2d& position, double radius, const cv::Scalar& colour);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, const cv::Scalar& colour);
  /// Draws grid, labels and frame over what lies outside the drawing area. To be called after the data.
  void finish_area();

  /// Entries of the legend, from the top down; after finish_area().
  void legend_line(const std::string& text, double width, const cv::Scalar& colour);
  void legend_dot(const std::string& text, double radius, const cv::Scalar& colour);
  void legend_text(const std::string& text);
  /// A colour scale with its ends labelled; `colours` from the low end to the high.
  void colour_bar(const std::vector<cv::Scalar>& colours, const std::string& low, const std::string& high,
                  const std::string& title);

  /// 1600 x 1200 px.
  cv::Mat image() const;

 private:
  cv::Point to_pixel(const Eigen::Vector2d& position) const;
  void text(const std::string& words, cv::Point position, double size, double anchor_x);
  void draw_grid();

  cv::Mat canvas_;
  cv::Rect area_;
  Eigen::Vector2d centre_;
  double pixels_per_metre_;
  std::string title_, x_label_, y_label_;
  int legend_y_;
};

}  // namespace stdc::app
