#include "run/ros2/ros2_status.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/quantiles.hpp"

namespace stdc::app {
namespace {

using Level = ros2::DiagnosticStatus::Level;

const char* in_words(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::ok:
      return "tracking";
    case TrackingStatus::uncertain:
      return "uncertain: little of what is seen agrees with the map";
    case TrackingStatus::lost:
      return "lost: going back to a place that is in the map helps";
    case TrackingStatus::initialising:
      return "no map yet: too little with depth in view";
    case TrackingStatus::skipped:
      return "frames are skipped";
  }
  return "";
}

Level level_of(TrackingStatus status) {
  if (status == TrackingStatus::ok) return Level::ok;
  return status == TrackingStatus::lost ? Level::error : Level::warning;
}

}  // namespace

void Ros2Status::add(const TrackingResult& result, std::optional<double> latency_ms) {
  constexpr std::size_t kKept = 900;
  ++frames_, ++new_frames_;
  located_ += has_pose(result.status) ? 1 : 0;
  lost_ += result.status == TrackingStatus::lost ? 1 : 0;
  if (latency_ms) latencies_.push_back(*latency_ms);
  if (latencies_.size() > kKept) latencies_.pop_front();
  last_.emplace();  // numbers only
  last_->status = result.status;
  last_->inliers = result.inliers;
  last_->map = result.map;
}

void Ros2Status::add_unreadable(const std::string& problem) {
  ++unreadable_, ++new_unreadable_;
  last_problem_ = problem;
}

ros2::DiagnosticStatus Ros2Status::camera_status(const ros2::Ros2Source& source, int new_frames) {
  const ros2::ReceptionCounts counts = source.counts();
  const std::vector<std::string> problems = source.problems();
  ros2::DiagnosticStatus status;
  status.name = "stdc_slam: camera";
  if (!problems.empty()) {
    status.level = new_frames > 0 ? Level::warning : Level::error;
    status.message = fmt::format("{}", fmt::join(problems, "; "));
  } else if (new_frames == 0) {
    status.level = Level::stale;
    status.message = "no frames since the last report";
  } else {
    status.message = "frames come in";
  }
  const auto add = [&](const char* key, int value) {
    status.values.emplace_back(key, std::to_string(value));
  };
  add("colour images", counts.colour);
  add("depth images", counts.depth);
  add("colour images without depth", counts.colour_without_depth);
  add("frames dropped because they came too late", counts.dropped);
  add("messages lost on the way", counts.lost);
  add("damaged messages", counts.damaged);
  add("images with stamps that go back", counts.backwards);
  add("times that the stamps began anew", counts.restarts);
  return status;
}

ros2::DiagnosticStatus Ros2Status::tracking_status() {
  ros2::DiagnosticStatus status;
  status.name = "stdc_slam: tracking";
  status.level = last_ ? level_of(last_->status) : Level::stale;
  status.message = last_ ? in_words(last_->status) : "no frame yet";
  if (new_unreadable_ > 0) {
    status.level = Level::error;
    status.message =
        fmt::format("{} frames since the last report could not be read: {}", new_unreadable_, last_problem_);
  }
  const auto add = [&](const char* key, const std::string& value) { status.values.emplace_back(key, value); };
  add("frames", std::to_string(frames_));
  add("frames since the last report", std::to_string(new_frames_));
  add("frames with a pose", std::to_string(located_));
  add("frames lost", std::to_string(lost_));
  add("frames unreadable", std::to_string(unreadable_));
  if (last_) add("inliers", std::to_string(last_->inliers));
  if (last_ && last_->map.valid()) add("map", std::to_string(last_->map.value));
  add("latency image to odometry", latency_text());
  if (!event_.empty()) add("last request", event_);
  return status;
}

std::vector<ros2::DiagnosticStatus> Ros2Status::report(const ros2::Ros2Source& source) {
  std::vector<ros2::DiagnosticStatus> statuses{camera_status(source, new_frames_ + new_unreadable_),
                                               tracking_status()};
  new_frames_ = new_unreadable_ = 0;
  return statuses;
}

std::string Ros2Status::latency_text() const {
  const Quantiles q = quantiles({latencies_.begin(), latencies_.end()});
  return fmt::format("p50 {}, p95 {}, p99 {} ms", to_text(q.median, 1), to_text(q.p95, 1), to_text(q.p99, 1));
}

}  // namespace stdc::app
