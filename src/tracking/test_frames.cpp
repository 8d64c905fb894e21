#include "tracking/test_frames.hpp"

#include <algorithm>

namespace stdc::test {

TrackedFrame tracked_frame(const MappedScene& mapped, const View& view, int index) {
  TrackedFrame frame(mapped.scene.camera, index, index / 30.0, view.features);
  frame.cam_from_world = view.cam_from_world;
  frame.set_motion(mapped.scene.camera, view.motion.twist);
  for (int i = 0; i < view.features->size(); ++i) {
    frame.landmarks[i] = mapped.landmarks[view.points[i]];
    frame.inliers += frame.landmarks[i].valid() ? 1 : 0;
  }
  return frame;
}

int point_of(const MappedScene& mapped, LandmarkId landmark) {
  const auto place = std::find(mapped.landmarks.begin(), mapped.landmarks.end(), landmark);
  return place == mapped.landmarks.end() ? -1 : static_cast<int>(place - mapped.landmarks.begin());
}

}  // namespace stdc::test
