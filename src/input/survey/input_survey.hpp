#pragma once

#include <functional>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "input/frame_source.hpp"
#include "input/survey/edge_alignment.hpp"

namespace stdc {

/// When the frames of an input were taken.
struct SurveyTimes {
  int frames = 0;
  double first = 0, last = 0;          ///< [s]
  double interval = 0;                 ///< median from one frame to the next [s]
  double jitter = 0;                   ///< 95 % of the intervals differ from the median by no more [s]
  int gaps = 0;                        ///< intervals of 2.5 times the median and more
  double longest_gap = 0, gap_at = 0;  ///< [s], and the time before it
  int backwards = 0;                   ///< frames that are not later than the one before
  /// Median time of depth minus time of colour [s]: what is left after the cameras' depth_time_offset.
  double depth_offset = 0;
  double depth_offset_spread = 0;  ///< 95 % of them differ from that by no more [s]

  double duration() const { return last - first; }
  double rate() const { return interval > 0 ? 1 / interval : 0; }
};

/// What the images of some frames are like.
struct SurveyImages {
  int sampled = 0;            ///< frames that were decoded
  int unreadable = 0;         ///< and frames that could not be
  std::string first_problem;  ///< why
  cv::Size colour_size, depth_size;
  int other_sizes = 0;           ///< frames whose sizes are not those
  bool grey = false;             ///< colour images have one channel
  bool depth_in_metres = false;  ///< floating point
  double brightness = 0;         ///< median over frames of the mean grey value
  double valid_share = 0;        ///< median over frames of the share of pixels with depth, as recorded
  double registered_share =
      0;  ///< the same in the pixels of the colour image; without a depth camera the same
  double median_depth = 0, far_depth = 0;  ///< median and 95 % of all depths, in units or metres
  double saturated_share = 0;              ///< pixels of 65535
  std::optional<EdgeShift> edges, left_edges, right_edges;
};

/// What was found in an input.
struct InputSurvey {
  std::string kind, where;
  std::vector<StreamInfo> streams;
  std::optional<RgbdCameras> cameras;
  std::string camera_hint;
  SurveyTimes times;
  SurveyImages images;
  int colour_without_depth = 0;
  std::optional<GroundTruth> truth;
  std::string truth_where, truth_problem;
  int imu_samples = 0;
  std::vector<std::string> notes, faults;
};

/// Goes through a whole input, decodes some of its frames, at most about `max_sampled`, and tells what it is
/// like.
/// @param cameras  of the user, before those of the source
/// @param progress called with the number of frames so far
InputSurvey survey_input(FrameSource& source, const std::optional<RgbdCameras>& cameras, int max_sampled,
                         const std::function<void(int)>& progress);

/// What is likely to be wrong, a line each, with what to do. Without cameras only what can be said without.
std::vector<std::string> survey_warnings(const InputSurvey& survey);

}  // namespace stdc
