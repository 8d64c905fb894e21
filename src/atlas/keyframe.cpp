#include "atlas/keyframe.hpp"

namespace stdc {

Measurement measure(const Camera& camera, const CameraMotion& motion, const Eigen::Vector2f& seen, float z,
                    float depth, float scale) {
  Measurement measurement{seen, seen, depth, scale};
  if (motion.readout_time == 0 || !(z > 0)) return measurement;
  const double dt = motion.row_time(camera.row_of(seen.cast<double>()));
  const Eigen::Vector3d point = motion.at_middle(camera.unproject(seen.cast<double>(), z), dt);
  if (!(point.z() > 0)) return measurement;
  measurement.pixel = camera.project(point).cast<float>();
  if (depth > 0) measurement.depth = depth * static_cast<float>(point.z() / z);
  return measurement;
}

std::vector<Measurement> measure_keypoints(const Camera& camera, const CameraMotion& motion,
                                           const FrameFeatures& features) {
  std::vector<Measurement> measurements(features.size());
  for (int i = 0; i < features.size(); ++i) {
    measurements[i].seen = features.pixel(i);
    measurements[i].scale = features.scale_of(i);
  }
  measure_again(camera, motion, features, measurements);
  return measurements;
}

void measure_again(const Camera& camera, const CameraMotion& motion, const FrameFeatures& features,
                   std::vector<Measurement>& measurements) {
  for (int i = 0; i < features.size(); ++i) {
    const float depth = features.depth(i);
    Measurement& m = measurements[i];
    m = measure(camera, motion, m.seen, depth > 0 ? depth : features.usual_depth(), depth, m.scale);
  }
}

}  // namespace stdc
