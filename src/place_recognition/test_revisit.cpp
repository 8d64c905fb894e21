#include "place_recognition/test_revisit.hpp"

namespace stdc::test {

Revisit::Revisit(const Scene& room, const Vector6d& drift_twist)
    : mapped(room), drift(Pose::exp(drift_twist)) {}

Vector6d Revisit::usual_drift() {
  Vector6d twist;
  twist << 0.12, -0.08, 0.2, 0.03, -0.05, 0.04;
  return twist;
}

void Revisit::visit_first(int keyframes) {
  for (int k = 0; k < keyframes; ++k) first.push_back(mapped.add(mapped.scene.look(pose(k), options(1 + k))));
}

void Revisit::visit_second(const Scene& room, int keyframes, const Pose& aside) {
  const Pose true_from_drifted = drift.inverse();
  std::vector<LandmarkId> landmarks(room.points.size());
  for (int k = 0; k < keyframes; ++k) {
    View view = room.look(aside * pose(k), options(100 + k));
    view.cam_from_world = view.cam_from_world * true_from_drifted;
    const KeyframeId id = mapped.add_bare(view);
    for (int i = 0; i < view.features->size(); ++i) {
      LandmarkId& landmark = landmarks[view.points[i]];
      if (!landmark.valid())
        landmark = mapped.atlas.add_landmark(drift * room.points[view.points[i]].position, id);
      mapped.atlas.observe(id, i, landmark);
      mapped.atlas.refresh(landmark);
    }
    mapped.atlas.update_covisibility(id);
    second.push_back(id);
  }
}

Pose Revisit::truth(KeyframeId id) const { return mapped.atlas.keyframe(id).cam_from_world * drift; }

Pose Revisit::pose(int k) { return camera_at(0.08 * k, 0.02 * k, 0.03 * k, 0.01 * k, -0.02 * k); }

ViewOptions Revisit::options(std::uint64_t seed) {
  ViewOptions options;
  options.depth_noise = 0.003;
  options.pixel_noise = 0.4;
  options.seed = seed;
  return options;
}

}  // namespace stdc::test
