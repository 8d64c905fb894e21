#include "atlas/landmark_alignment.hpp"

#include <Eigen/LU>
#include <cmath>

#include "features/description/patch_alignment.hpp"

namespace stdc {
namespace {

/// Ideal pixel offsets of the view per ideal pixel offset of the reference view, around a landmark (Forster
/// et al., 'SVO', ICRA 2014, sec. V). Nothing where the landmark is behind either.
std::optional<Eigen::Matrix2f> warp_from_reference(const Camera& camera, const ReferenceView& reference,
                                                   const Eigen::Vector3d& position,
                                                   const Pose& cam_from_world) {
  constexpr double kNearest = 0.05;  // [m]
  const Eigen::Vector3d in_reference = reference.cam_from_world * position;
  const Eigen::Vector3d in_view = cam_from_world * position;
  if (!(in_reference.z() > kNearest && in_view.z() > kNearest)) return {};
  // Derivative of: reference view pixel -> point at the reference view's depth -> view -> pixel.
  const Eigen::Matrix3d rotation =
      (cam_from_world.rotation * reference.cam_from_world.rotation.conjugate()).matrix();
  Eigen::Matrix<double, 3, 2> point_per_pixel;
  point_per_pixel.col(0) = rotation.col(0) * (in_reference.z() / camera.fx);
  point_per_pixel.col(1) = rotation.col(1) * (in_reference.z() / camera.fy);
  const double inverse_z = 1 / in_view.z();
  Eigen::Matrix<double, 2, 3> pixel_per_point;
  pixel_per_point << camera.fx * inverse_z, 0, -camera.fx * in_view.x() * inverse_z * inverse_z,  //
      0, camera.fy * inverse_z, -camera.fy * in_view.y() * inverse_z * inverse_z;
  return (pixel_per_point * point_per_pixel).cast<float>();
}

struct Target {
  ImageView image;
  float scale = 1;                                   ///< of its level
  Eigen::Vector2f start = Eigen::Vector2f::Zero();   ///< [px of the image]
  Eigen::Vector2f origin = Eigen::Vector2f::Zero();  ///< of the image on its level [px]
};

std::optional<AlignedObservation> align(const SensorModel& sensor, const ReferenceView& reference,
                                        const Eigen::Matrix2f& warp, const Target& target, float reach) {
  const float reference_scale = reference.features->scale_of(reference.keypoint);
  PatchTemplate pattern;
  if (!pattern.make(*reference.features->patch(reference.keypoint), warp * (reference_scale / target.scale)))
    return {};
  Eigen::Vector2f found = target.start;
  if (!pattern.align(target.image, reach, found)) return {};
  found += target.origin;
  const Eigen::Vector2d raw(level_to_image(found.x(), target.scale), level_to_image(found.y(), target.scale));
  // The reference view may see the landmark a little beside the middle of its patch.
  const Eigen::Vector2f beside = warp * (reference.seen - reference.features->pixel(reference.keypoint));
  const float coarser = std::max(target.scale, reference_scale * std::sqrt(std::abs(warp.determinant())));
  return AlignedObservation{sensor.camera.undistort(raw).cast<float>() + beside,
                            coarser * sensor.aligned_scale()};
}

}  // namespace

ReferenceView reference_view_of(const Atlas& atlas, const Landmark& landmark) {
  const Observation& oldest = landmark.observations.front();
  const Keyframe& keyframe = atlas.keyframe(oldest.keyframe);
  return {keyframe.features.get(), oldest.keypoint, keyframe.cam_from_world,
          keyframe.measurements[oldest.keypoint].seen};
}

std::optional<AlignedObservation> align_in_image(const SensorModel& sensor, const ReferenceView& reference,
                                                 const Eigen::Vector3d& position, const Pose& cam_from_world,
                                                 const FrameFeatures& features, const Pyramid& pyramid,
                                                 const Eigen::Vector2f& start, float reach) {
  if (reference.features->patch(reference.keypoint) == nullptr) return {};
  const auto warp = warp_from_reference(sensor.camera, reference, position, cam_from_world);
  if (!warp) return {};
  const float scale =
      reference.features->scale_of(reference.keypoint) * std::sqrt(std::abs(warp->determinant()));
  if (!(scale > 0.5F)) return {};
  const int level = features.nearest_level(scale);
  Target target{pyramid.level(level).view(), features.scale(level), start, Eigen::Vector2f::Zero()};
  target.start = {image_to_level(start.x(), target.scale), image_to_level(start.y(), target.scale)};
  return align(sensor, reference, *warp, target, reach);
}

void align_observation(Atlas& atlas, const SensorModel& sensor, LandmarkId landmark_id,
                       KeyframeId keyframe_id) {
  constexpr float kReach = 3;  // what the stored patch has room for
  const Landmark& landmark = atlas.landmark(landmark_id);
  if (landmark.observations.front().keyframe == keyframe_id) return;
  const int keypoint = atlas.keypoint_of(landmark_id, keyframe_id);
  const Keyframe& keyframe = atlas.keyframe(keyframe_id);
  const FrameFeatures& features = *keyframe.features;
  AlignedObservation observation{features.pixel(keypoint), features.scale_of(keypoint)};
  const ReferenceView reference = reference_view_of(atlas, landmark);
  const auto warp = warp_from_reference(sensor.camera, reference, landmark.position, keyframe.cam_from_world);
  const Patch* patch = features.patch(keypoint);
  if (warp && patch != nullptr && reference.features->patch(reference.keypoint) != nullptr) {
    const Eigen::Vector2f middle(Patch::kCentre, Patch::kCentre);
    Target target{patch->view(), features.scale_of(keypoint), middle, Eigen::Vector2f::Zero()};
    const Keypoint& raw = features.keypoint(keypoint);
    target.origin = Eigen::Vector2f(std::round(image_to_level(raw.x, target.scale)),
                                    std::round(image_to_level(raw.y, target.scale))) -
                    middle;
    observation = align(sensor, reference, *warp, target, kReach).value_or(observation);
  }
  const auto z = static_cast<float>((keyframe.cam_from_world * landmark.position).z());
  atlas.set_measurement(keyframe_id, keypoint,
                        measure(sensor.camera, keyframe.motion, observation.seen, z, features.depth(keypoint),
                                observation.scale));
}

}  // namespace stdc
