#include "motion/make_motion_detector.hpp"

#include "motion/map_motion.hpp"

namespace stdc {

std::unique_ptr<MotionDetector> make_motion_detector(const Camera& camera, const MotionSettings& settings) {
  switch (settings.method) {
    case MotionMethod::off:
      return nullptr;
    case MotionMethod::flow:
    case MotionMethod::multi_view:
    case MotionMethod::map:
      return std::make_unique<MapMotion>(camera, settings);
  }
  return nullptr;
}

}  // namespace stdc
