#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "atlas/keyframe.hpp"
#include "core/ids.hpp"
#include "core/pose.hpp"
#include "features/frame_features.hpp"
#include "tracking/tracking_settings.hpp"

namespace stdc {

/// A frame and what the tracker found out about it.
struct TrackedFrame {
  int index = 0;         ///< of the input frame
  double timestamp = 0;  ///< [s]
  std::shared_ptr<const FrameFeatures> features;
  std::shared_ptr<const Pyramid> pyramid;  ///< of the image; no longer than the frame is the last one
  std::vector<float> grid_depths;          ///< z [m] at DirectAligner's grid; empty: not to be aligned
  Pose cam_from_world;                     ///< when the middle row was read
  CameraMotion motion;                     ///< about that pose
  std::vector<Measurement> measurements;   ///< per keypoint
  std::vector<LandmarkId> landmarks;       ///< per keypoint; invalid: none
  std::vector<std::uint8_t> outlier;  ///< per keypoint: 1 if it was matched and the optimisation refused it
  std::vector<std::uint8_t> dynamic;  ///< per keypoint: 1 if it lies on something that moves
  Matrix6d information = Matrix6d::Zero();  ///< of the pose, see PoseOptimisationResult
  /// The same of the landmarks alone that have been in the map for a while; nothing: all of them have.
  std::optional<Matrix6d> old_information;
  /// How far the camera is from where those alone have it, if that is more than chance [m].
  double old_offset = 0;
  /// How far the camera is from where its velocity took it, in sigmas of the motion prior; 0: not known.
  double jump = 0;
  std::optional<PosePrior>
      aligned;      ///< pose found by direct alignment; it goes before that of the motion model
  int matches = 0;  ///< keypoints matched to landmarks or temporary points, before the first optimisation
                    ///< with the local map
  int inliers = 0;  ///< landmarks that agree with the pose in the end
  int temporary_inliers = 0;  ///< the same of the temporary points

  TrackedFrame() = default;
  /// At rest until the tracker knows better.
  TrackedFrame(const Camera& camera, int frame_index, double time,
               std::shared_ptr<const FrameFeatures> frame_features,
               std::shared_ptr<const Pyramid> image_pyramid = nullptr)
      : index(frame_index),
        timestamp(time),
        features(std::move(frame_features)),
        pyramid(std::move(image_pyramid)) {
    motion = CameraMotion(camera, Vector6d::Zero());
    measurements = measure_keypoints(camera, motion, *features);
    landmarks.resize(features->size());
    outlier.resize(features->size(), 0);
    dynamic.resize(features->size(), 0);
  }
  /// Of the pose: of its matches and of the map. Left perturbation; translation [m], rotation [rad].
  Matrix6d covariance(const TrackingSettings& settings) const { return covariance(information, settings); }
  static Matrix6d covariance(const Matrix6d& information, const TrackingSettings& settings);
  /// Takes another motion out of the measurements. `twist`: of cam_from_world, per second.
  void set_motion(const Camera& camera, const Vector6d& twist) {
    motion = CameraMotion(camera, twist);
    if (motion.readout_time != 0) measure_again(camera, motion, *features, measurements);
  }
};

/// The largest sigma of the position in a covariance of TrackedFrame [m].
inline double position_sigma(const Matrix6d& covariance) {
  return std::sqrt(covariance.diagonal().head<3>().maxCoeff());
}

}  // namespace stdc
