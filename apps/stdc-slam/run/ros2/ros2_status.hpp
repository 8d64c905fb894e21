#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "input/recordings/messages/ros2_messages.hpp"
#include "ros2/ros2_source.hpp"
#include "slam/tracking_result.hpp"

namespace stdc::app {

/// How the node of `stdc-slam ros2` is doing, for /diagnostics and the terminal.
class Ros2Status {
 public:
  /// @param latency_ms  from the later image to the sent pose, if known
  void add(const TrackingResult& result, std::optional<double> latency_ms);
  /// A frame whose images could not be read, and why.
  void add_unreadable(const std::string& problem);
  /// What was done at request or could not be, until the next one.
  void set_event(const std::string& event) { event_ = event; }

  /// Of the camera and of tracking; the latter's counts are of the time since the last call.
  std::vector<ros2::DiagnosticStatus> report(const ros2::Ros2Source& source);
  /// Where there is no tracking yet.
  static ros2::DiagnosticStatus camera_status(const ros2::Ros2Source& source, int new_frames);

  /// Quantiles of the latency of the last frames: "p50 12.1, p95 14.0, p99 15.2 ms".
  std::string latency_text() const;
  int frames() const { return frames_; }
  int located() const { return located_; }
  int unreadable() const { return unreadable_; }

 private:
  ros2::DiagnosticStatus tracking_status();

  std::optional<TrackingResult> last_;
  std::deque<double> latencies_;  ///< of the last frames [ms]
  std::string last_problem_, event_;
  int frames_ = 0, located_ = 0, lost_ = 0, unreadable_ = 0;
  int new_frames_ = 0, new_unreadable_ = 0;  ///< since the last report
};

}  // namespace stdc::app
