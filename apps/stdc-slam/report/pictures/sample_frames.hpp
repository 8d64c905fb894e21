#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/survey/depth_warnings.hpp"
#include "run/frame_observer.hpp"
#include "slam/slam.hpp"

namespace stdc::app {

/// A frame of a run, small enough for a page.
struct SampleFrame {
  int number = 0;        ///< in the input
  double timestamp = 0;  ///< [s]
  std::string text;      ///< "312 inliers, 22 % dynamic"
  std::vector<std::uint8_t> jpeg;
};

/// Keeps some frames of a run with their masks and keypoints: at even distances, where tracking fails, and
/// where most of the view moves; and looks at their depth.
class SampleFrames : public FrameObserver {
 public:
  /// @param slam      that tracks the frames; asked what it found in those that are kept
  /// @param expected  how many frames there will be, if that is about known
  SampleFrames(Slam& slam, std::optional<int> expected);

  void on_frame(const ObservedFrame& frame) override;
  /// By number.
  std::vector<SampleFrame> frames() const;
  /// What their depth is like; nothing if no frame was kept.
  std::optional<DepthLook> depth() const;
  /// Whether that is in metres.
  bool depth_in_metres() const { return in_metres_; }

 private:
  bool is_regular(int index);
  SampleFrame sample(const ObservedFrame& frame);
  void look_at_depth(const cv::Mat& depth);

  Slam& slam_;
  int every_ = 1;
  std::vector<SampleFrame> regular_, failed_;
  std::optional<SampleFrame> busiest_;
  double most_dynamic_ = 0;
  TrackingStatus last_ = TrackingStatus::ok;
  bool in_metres_ = false;
  std::vector<double> depths_;  ///< of some pixels
  std::size_t pixels_ = 0, saturated_ = 0;
};

}  // namespace stdc::app
