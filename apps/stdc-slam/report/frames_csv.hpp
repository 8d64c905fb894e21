#pragma once

#include <string>
#include <vector>

#include "slam/tracking_result.hpp"

namespace stdc::app {

/// One row per input frame, with a head line. Times in milliseconds; the columns of mapping are empty where
/// no mapping result was collected.
std::string frames_csv(const std::vector<TrackingResult>& results);

}  // namespace stdc::app
