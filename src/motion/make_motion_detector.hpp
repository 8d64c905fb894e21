#pragma once

#include <memory>

#include "motion/motion_detector.hpp"
#include "motion/motion_settings.hpp"

namespace stdc {

/// The method of the settings; null for `off`.
std::unique_ptr<MotionDetector> make_motion_detector(const Camera& camera, const MotionSettings& settings);

}  // namespace stdc
