#pragma once

#include <array>
#include <utility>

#include "core/setting.hpp"

namespace stdc {

/// How moving things are found by geometry, with or without a segmenter.
enum class MotionMethod {
  off,
  flow,        ///< optical flow against the motion of the static part, as PSPNet-SLAM and DS-SLAM do
  multi_view,  ///< keypoints of keyframes projected into the frame, as DynaSLAM does
  map,         ///< the depth that is known of the static scene against what is seen
};

template <>
struct EnumNames<MotionMethod> {
  static constexpr std::array values{
      std::pair{MotionMethod::off, "off"}, std::pair{MotionMethod::flow, "flow"},
      std::pair{MotionMethod::multi_view, "multi-view"}, std::pair{MotionMethod::map, "map"}};
};

/// Settings of the search for what moves.
struct MotionSettings {
  STDC_SETTING(MotionMethod, method, MotionMethod::map, "How moving things are found by geometry");
  STDC_SETTING(double, depth_tolerance, 0.04, "m", 0.001, 1,
               "map: depths that differ by less are the same surface...");
  STDC_SETTING(double, depth_tolerance_growth, 0.012, "1/m", 0, 0.1, "...and by this times z^2 more");
  STDC_SETTING(
      double, time_tolerance, 0.008, "s", 0, 0.1,
      "map: depth and pose may be so far apart in time, which blurs depth edges while the camera turns");
  STDC_SETTING(int, min_cells, 30, "count", 1, 1000,
               "map: smaller patches (of about 4 x 4 px each) do not count");
  STDC_SETTING(double, rest_time, 4, "s", 0.1, 600,
               "map: a thing that appeared belongs to the static scene after resting for so long");
  STDC_SETTING(double, min_agreement, 0.65, "ratio", 0, 1,
               "map: a pose that explains less of the known static scene is uncertain");
  STDC_SETTING(double, min_likeness, 0.35, "ratio", 0, 1,
               "map: ...and so is one at which less of it looks as it did");
  STDC_SETTING(int, views, 6, "count", 1, 32, "map: earlier views that a frame is compared with");
  STDC_SETTING(int, max_views, 128, "count", 4, 4096, "map: earlier views kept");
  STDC_SETTING(double, evidence, 1.2, "log-odds", 0.01, 10, "map: weight of one comparison of a cell");
  STDC_SETTING(double, smoothing, 0.4, "ratio", 0, 1,
               "map: share of a cell's belief that it takes from its neighbours on the same surface");
  STDC_SETTING(int, multi_view_keyframes, 5, "count", 1, 32,
               "multi-view: keyframes that a frame is compared with, those that overlap it most");
  STDC_SETTING(double, multi_view_tau, 0.4, "m", 0.01, 5,
               "multi-view: what is nearer than a point of a keyframe by more than this is dynamic (tau_z)");
  STDC_SETTING(double, multi_view_parallax, 30, "deg", 1, 180,
               "multi-view: points seen under a larger parallax do not count");
  STDC_SETTING(int, multi_view_min_points, 3, "count", 1, 1000,
               "multi-view: dynamic points that make a region");
  STDC_SETTING(int, multi_view_max_keyframes, 200, "count", 1, 10000,
               "multi-view: keyframes whose points are kept");
  STDC_SETTING(double, flow_threshold, 1, "px", 0.1, 20,
               "flow: a point that is off the motion of the static part by more is dynamic");
  STDC_SETTING(int, flow_lag, 3, "frames", 1, 10, "flow: distance of the two frames that are compared");
  STDC_SETTING(int, flow_min_points, 5, "count", 1, 1000, "flow: dynamic points that make a region");
  STDC_SETTING(int, flow_seed, 1, "", 0, 1e9, "flow: seed of RANSAC");
};

}  // namespace stdc
