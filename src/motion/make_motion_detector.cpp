#include "motion/make_motion_detector.hpp"

#include "motion/flow/flow_motion.hpp"
#include "motion/map_motion.hpp"
#include "motion/multi_view/multi_view_motion.hpp"

namespace stdc {

std::unique_ptr<MotionDetector> make_motion_detector(const Camera& camera, const MotionSettings& settings) {
  switch (settings.method) {
    case MotionMethod::off:
      return nullptr;
    case MotionMethod::flow:
      return std::make_unique<FlowMotion>(camera, settings);
    case MotionMethod::multi_view:
      return std::make_unique<MultiViewMotion>(camera, settings);
    case MotionMethod::map:
      return std::make_unique<MapMotion>(camera, settings);
  }
  return nullptr;
}

}  // namespace stdc
