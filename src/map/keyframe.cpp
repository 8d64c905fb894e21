#include "map/keyframe.hpp"

#include <algorithm>

namespace stdc {

Measurement measure(const Camera& camera, const CameraMotion& motion, const Eigen::Vector2f& seen, float z,
                    float depth, float scale) {
  Measurement measurement{seen, seen, depth, scale};
  if (motion.readout_time == 0 || !(z > 0)) return measurement;
  const double dt = motion.row_time(seen.y());
  const Eigen::Vector3d point = motion.at_middle(camera.unproject(seen.cast<double>(), z), dt);
  if (!(point.z() > 0)) return measurement;
  measurement.pixel = camera.project(point).cast<float>();
  if (depth > 0) measurement.depth = depth * static_cast<float>(point.z() / z);
  return measurement;
}

std::vector<Measurement> measure_keypoints(const Camera& camera, const CameraMotion& motion,
                                           const FrameFeatures& features) {
  std::vector<float> depths;
  for (int i = 0; i < features.size(); ++i) {
    if (features.depth(i) > 0) depths.push_back(features.depth(i));
  }
  float usual = 1;
  if (!depths.empty()) {
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    usual = *middle;
  }
  std::vector<Measurement> measurements(features.size());
  for (int i = 0; i < features.size(); ++i) {
    const float depth = features.depth(i);
    measurements[i] =
        measure(camera, motion, features.pixel(i), depth > 0 ? depth : usual, depth, features.scale_of(i));
  }
  return measurements;
}

}  // namespace stdc
