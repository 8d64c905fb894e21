#include "report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace stdc::app {
namespace {

constexpr int kWidth = 1600, kHeight = 1200;                        // of the finished picture [px]
constexpr int kLeft = 110, kRight = 300, kTop = 80, kBottom = 100;  // margins [px]
constexpr int kFactor = 2;                                          // drawn so many times larger
constexpr int kPlotShift = 4;                                       // fraction bits of coordinates
const cv::Scalar kInk(50, 50, 50), kGrid(225, 225, 225), kPaper(255, 255, 255);

/// The largest of 1, 2, 5 times a power of ten that gives at least five steps over `range`.
double tick_step(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 5)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= range / 5) return factor * power;
  }
  return power;
}

int scaled(double length) { return std::max(1, cvRound(length * kFactor)); }

}  // namespace

Plot::Plot(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const std::string& title,
           const std::string& x_label, const std::string& y_label)
    : canvas_(kHeight * kFactor, kWidth * kFactor, CV_8UC3, kPaper),
      area_(kLeft * kFactor, kTop * kFactor, (kWidth - kLeft - kRight) * kFactor,
            (kHeight - kTop - kBottom) * kFactor),
      centre_(0.5 * (low + high)),
      title_(title),
      x_label_(x_label),
      y_label_(y_label),
      legend_y_((kTop + 10) * kFactor) {
  const Eigen::Vector2d extent = (high - low).cwiseMax(0.1);  // a camera that stands still has none
  pixels_per_metre_ = std::min(area_.width / extent.x(), area_.height / extent.y());
  draw_grid();
}

cv::Point Plot::to_pixel(const Eigen::Vector2d& position) const {
  const double one = 1 << kPlotShift;
  const double x = area_.x + 0.5 * area_.width + pixels_per_metre_ * (position.x() - centre_.x());
  const double y = area_.y + 0.5 * area_.height - pixels_per_metre_ * (position.y() - centre_.y());
  // Far points are kept from overflowing OpenCV's integers; they are outside the area all the same.
  const auto fixed = [&](double v) { return cvRound(std::clamp(v, -20000.0, 20000.0) * one); };
  return {fixed(x), fixed(y)};
}

void Plot::dot(const Eigen::Vector2d& position, double radius, const cv::Scalar& colour) {
  cv::circle(canvas_, to_pixel(position), cvRound(radius * kFactor * (1 << kPlotShift)), colour, cv::FILLED,
             cv::LINE_AA, kPlotShift);
}

void Plot::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
                const cv::Scalar& colour) {
  cv::line(canvas_, to_pixel(from), to_pixel(to), colour, scaled(width), cv::LINE_AA, kPlotShift);
}

void Plot::text(const std::string& words, cv::Point position, double size, double anchor_x) {
  const double height = size * kFactor / 22;  // the font's own capitals are 22 px high
  int baseline = 0;
  const cv::Size extent = cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, height, kFactor, &baseline);
  position.x -= cvRound(anchor_x * extent.width);
  position.y += extent.height / 2;
  cv::putText(canvas_, words, position, cv::FONT_HERSHEY_SIMPLEX, height, kInk, kFactor, cv::LINE_AA);
}

void Plot::draw_grid() {
  const Eigen::Vector2d half(0.5 * area_.width / pixels_per_metre_, 0.5 * area_.height / pixels_per_metre_);
  const double step = tick_step(2 * half.y());
  for (int axis = 0; axis < 2; ++axis) {
    const double end = centre_[axis] + half[axis];
    for (double value = std::ceil((centre_[axis] - half[axis]) / step) * step; value <= end; value += step) {
      Eigen::Vector2d from = centre_ - half, to = centre_ + half;
      from[axis] = to[axis] = value;
      line(from, to, 1, kGrid);
    }
  }
}

void Plot::finish_area() {
  const cv::Rect& a = area_;
  canvas_.rowRange(0, a.y).setTo(kPaper);
  canvas_.rowRange(a.y + a.height, canvas_.rows).setTo(kPaper);
  canvas_.colRange(0, a.x).setTo(kPaper);
  canvas_.colRange(a.x + a.width, canvas_.cols).setTo(kPaper);
  cv::rectangle(canvas_, a, kInk, kFactor);
  const Eigen::Vector2d half(0.5 * a.width / pixels_per_metre_, 0.5 * a.height / pixels_per_metre_);
  const double step = tick_step(2 * half.y());
  const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  constexpr double kLabelSize = 15;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = centre_[axis] - half[axis], end = centre_[axis] + half[axis];
    for (double value = std::ceil(low / step) * step; value <= end; value += step) {
      const double shown = std::abs(value) < 1e-9 * step ? 0 : value;
      const std::string label = fmt::format("{:.{}f}", std::abs(shown) < step / 2 ? 0.0 : shown, digits);
      const int offset = cvRound((value - low) * pixels_per_metre_);
      if (axis == 0) {
        text(label, {a.x + offset, a.y + a.height + 22 * kFactor}, kLabelSize, 0.5);
      } else {
        text(label, {a.x - 12 * kFactor, a.y + a.height - offset}, kLabelSize, 1);
      }
    }
  }
  text(title_, {a.x, a.y - 36 * kFactor}, 20, 0);
  text(x_label_, {a.x + a.width / 2, a.y + a.height + 62 * kFactor}, 17, 0.5);
  text(y_label_, {a.x - 95 * kFactor, a.y - 18 * kFactor}, 17, 0);
}

void Plot::legend_line(const std::string& words, double width, const cv::Scalar& colour) {
  const int x = area_.x + area_.width + 20 * kFactor;
  cv::line(canvas_, {x, legend_y_}, {x + 40 * kFactor, legend_y_}, colour, scaled(width), cv::LINE_AA);
  text(words, {x + 52 * kFactor, legend_y_}, 16, 0);
  legend_y_ += 34 * kFactor;
}

void Plot::legend_dot(const std::string& words, double radius, const cv::Scalar& colour) {
  const int x = area_.x + area_.width + 20 * kFactor;
  cv::circle(canvas_, {x + 20 * kFactor, legend_y_}, scaled(radius), colour, cv::FILLED, cv::LINE_AA);
  text(words, {x + 52 * kFactor, legend_y_}, 16, 0);
  legend_y_ += 34 * kFactor;
}

void Plot::legend_text(const std::string& words) {
  text(words, {area_.x + area_.width + 20 * kFactor, legend_y_}, 16, 0);
  legend_y_ += 34 * kFactor;
}

void Plot::colour_bar(const std::vector<cv::Scalar>& colours, const std::string& low, const std::string& high,
                      const std::string& title) {
  legend_y_ += 20 * kFactor;
  legend_text(title);
  const int x = area_.x + area_.width + 20 * kFactor, height = 300 * kFactor, width = 24 * kFactor;
  const int count = static_cast<int>(colours.size());
  for (int i = 0; i < count; ++i) {
    const int top = legend_y_ + height * (count - 1 - i) / count;
    const int bottom = legend_y_ + height * (count - i) / count;
    cv::rectangle(canvas_, {x, top}, {x + width, bottom}, colours[static_cast<std::size_t>(i)], cv::FILLED);
  }
  cv::rectangle(canvas_, {x, legend_y_}, {x + width, legend_y_ + height}, kInk, 1);
  text(high, {x + 36 * kFactor, legend_y_ + 6 * kFactor}, 16, 0);
  text(low, {x + 36 * kFactor, legend_y_ + height - 6 * kFactor}, 16, 0);
  legend_y_ += height + 34 * kFactor;
}

cv::Mat Plot::image() const {
  cv::Mat small;
  cv::resize(canvas_, small, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace stdc::app
