#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "report/debug_images.hpp"
#include "report/plot.hpp"

namespace stdc::app {
namespace {

const cv::Scalar kTruth(150, 150, 150), kEstimate(200, 90, 20), kKeyframe(40, 40, 40),
    kLandmark(190, 165, 120);

/// Blue to red through green and yellow, without the dark ends.
std::vector<cv::Scalar> error_colours() {
  cv::Mat ramp(1, 256, CV_8UC1), coloured;
  for (int i = 0; i < 256; ++i) ramp.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
  cv::applyColorMap(ramp, coloured, cv::COLORMAP_TURBO);
  std::vector<cv::Scalar> colours;
  for (int i = 25; i < 235; ++i) colours.emplace_back(coloured.at<cv::Vec3b>(i));
  return colours;
}

/// A point of the drawing plane.
class Projection {
 public:
  explicit Projection(bool true_frame) : true_frame_(true_frame) {}
  Eigen::Vector2d operator()(const Eigen::Vector3d& p) const {
    return true_frame_ ? Eigen::Vector2d(p.x(), p.y()) : Eigen::Vector2d(p.x(), p.z());
  }

 private:
  bool true_frame_;
};

/// The true position at a time, between the two poses around it; nothing outside or in a gap.
std::optional<Eigen::Vector3d> position_at(const Trajectory& truth, double time) {
  constexpr double kMaxGap = 0.1;  // [s]
  const auto after = std::lower_bound(truth.begin(), truth.end(), time,
                                      [](const StampedPose& pose, double t) { return pose.timestamp < t; });
  if (after == truth.end()) return std::nullopt;
  if (after->timestamp == time) return after->world_from_cam.translation;
  if (after == truth.begin() || after->timestamp - (after - 1)->timestamp > kMaxGap) return std::nullopt;
  const StampedPose& before = *(after - 1);
  const double share = (time - before.timestamp) / (after->timestamp - before.timestamp);
  return (1 - share) * before.world_from_cam.translation + share * after->world_from_cam.translation;
}

struct Segment {
  Eigen::Vector2d from, to;
};

/// Pieces of a path; none across gaps, which would show a way that nobody has seen.
std::vector<Segment> segments(const Trajectory& path, const Pose& drawn_from_path,
                              const Projection& project) {
  constexpr double kMaxGap = 0.25;  // [s]
  std::vector<Segment> pieces;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path[i].timestamp - path[i - 1].timestamp > kMaxGap) continue;
    pieces.push_back({project(drawn_from_path * path[i - 1].world_from_cam.translation),
                      project(drawn_from_path * path[i].world_from_cam.translation)});
  }
  return pieces;
}

/// The truth while the estimate lasts: recordings of the truth start earlier and end later.
Trajectory common_part(const Trajectory& truth, const Trajectory& estimate) {
  Trajectory part;
  for (const StampedPose& pose : truth) {
    if (estimate.empty() || pose.timestamp < estimate.front().timestamp) continue;
    if (pose.timestamp <= estimate.back().timestamp) part.push_back(pose);
  }
  return part;
}

Plot make_plot(const std::vector<Eigen::Vector2d>& points, bool true_frame) {
  Eigen::Vector2d low(0, 0), high(0, 0);
  if (!points.empty()) low = high = points.front();
  for (const Eigen::Vector2d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(0.1 * std::max((high - low).maxCoeff(), 0.1));
  return {low - margin, high + margin, "The trajectory from above",
          true_frame ? "x [m], frame of the ground truth" : "x [m], frame of the first camera",
          true_frame ? "y [m]" : "z [m]"};
}

/// Draws the estimate piece by piece in the colour of its error and explains the colours.
void draw_coloured(Plot& plot, const TopView& view, const Pose& truth_from_estimate,
                   const Projection& project, std::vector<double>& errors) {
  const std::vector<cv::Scalar> colours = error_colours();
  errors.assign(view.estimate.size(), -1);
  for (std::size_t i = 0; i < view.estimate.size(); ++i) {
    const auto truth = position_at(view.truth, view.estimate[i].timestamp);
    if (truth)
      errors[i] = (truth_from_estimate * view.estimate[i].world_from_cam.translation - *truth).norm();
  }
  const double largest = std::max(1e-6, *std::max_element(errors.begin(), errors.end()));
  for (std::size_t i = 1; i < view.estimate.size(); ++i) {
    const Trajectory piece{view.estimate[i - 1], view.estimate[i]};
    const auto index = static_cast<std::size_t>(std::max(0.0, errors[i]) / largest *
                                                static_cast<double>(colours.size() - 1));
    for (const Segment& s : segments(piece, truth_from_estimate, project)) {
      plot.line(s.from, s.to, 2.5, errors[i] < 0 ? kEstimate : colours[index]);
    }
  }
}

void draw_legend(Plot& plot, const TopView& view, const std::vector<double>& errors) {
  const bool scored = !errors.empty();
  if (scored) plot.legend_line("ground truth", 5, kTruth);
  plot.legend_line("estimate", 2.5, kEstimate);
  plot.legend_dot(fmt::format("keyframe ({})", view.keyframes.size()), 4, kKeyframe);
  plot.legend_dot(fmt::format("landmark ({})", view.landmarks.size()), 3, kLandmark);
  if (!scored) return;
  const double largest = *std::max_element(errors.begin(), errors.end());
  plot.colour_bar(error_colours(), "0 mm", fmt::format("{:.1f} mm", 1e3 * largest), "error of position");
}

}  // namespace

cv::Mat draw_top_view(const TopView& view) {
  const bool true_frame = view.truth_from_estimate.has_value() && !view.estimate.empty();
  const Pose drawn_from_estimate = true_frame ? *view.truth_from_estimate : Pose();
  const Projection project(true_frame);
  const std::vector<Segment> truth =
      true_frame ? segments(common_part(view.truth, view.estimate), Pose(), project) : std::vector<Segment>();
  std::vector<Eigen::Vector2d> visible;
  for (const Segment& s : truth) visible.push_back(s.to);
  for (const StampedPose& pose : view.estimate) {
    visible.push_back(project(drawn_from_estimate * pose.world_from_cam.translation));
  }
  Plot plot = make_plot(visible, true_frame);
  for (const Eigen::Vector3d& landmark : view.landmarks) {
    plot.dot(project(drawn_from_estimate * landmark), 1.5, kLandmark);
  }
  for (const Segment& s : truth) plot.line(s.from, s.to, 5, kTruth);
  std::vector<double> errors;
  if (true_frame) {
    draw_coloured(plot, view, drawn_from_estimate, project, errors);
  } else {
    for (const Segment& s : segments(view.estimate, Pose(), project)) plot.line(s.from, s.to, 2.5, kEstimate);
  }
  for (const StampedPose& pose : view.keyframes) {
    plot.dot(project(drawn_from_estimate * pose.world_from_cam.translation), 3.5, kKeyframe);
  }
  plot.finish_area();
  draw_legend(plot, view, errors);
  return plot.image();
}

}  // namespace stdc::app
