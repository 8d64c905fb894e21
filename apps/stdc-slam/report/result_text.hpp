#pragma once

#include <array>

#include "slam/tracking_result.hpp"

namespace stdc::app {

/// A stage of a frame as it is called in summary.json and frames.csv.
struct StageName {
  const char* name;
  double StageTimes::*time;
};

inline constexpr std::array kStageNames{
    StageName{"extraction", &StageTimes::extraction},
    StageName{"mask_wait", &StageTimes::mask_wait},
    StageName{"rejection", &StageTimes::rejection},
    StageName{"prediction", &StageTimes::prediction},
    StageName{"local_map", &StageTimes::local_map},
    StageName{"relocalisation", &StageTimes::relocalisation},
    StageName{"keyframe", &StageTimes::keyframe},
    StageName{"wait", &StageTimes::wait},
    StageName{"total", &StageTimes::total},
    StageName{"total_cpu", &StageTimes::total_cpu},
};

/// Keyframes in a local bundle adjustment, those held fixed included.
inline int keyframes_in(const LocalBundleReport& bundle) { return bundle.keyframes + bundle.fixed_keyframes; }

/// "ok", "lost", ...
const char* status_name(TrackingStatus status);

}  // namespace stdc::app
