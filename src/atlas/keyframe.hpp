#pragma once

#include <memory>
#include <vector>

#include "core/camera.hpp"
#include "core/camera_motion.hpp"
#include "core/ids.hpp"
#include "core/pose.hpp"
#include "features/frame_features.hpp"

namespace stdc {

/// A keyframe that shares landmarks with another, and how many.
struct Covisible {
  KeyframeId keyframe;
  int shared = 0;
};

/// Where exactly a keypoint sees what it sees.
struct Measurement {
  Eigen::Vector2f seen = Eigen::Vector2f::Zero();   ///< ideal pixel, as the image has it
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  ///< ideal pixel, as seen from the pose of the middle row
  float depth = 0;                                  ///< z from there [m]; 0: missing
  float scale = 1;                                  ///< its noise is NoiseSettings::pixel_sigma times this
};

/// Takes the rolling shutter out of a observation.
/// @param z  of the point [m], for the part of the shift that depends on it
Measurement measure(const Camera& camera, const CameraMotion& motion, const Eigen::Vector2f& seen, float z,
                    float depth, float scale);

/// The same for all keypoints at their own positions; those without depth are taken to be as far as most.
std::vector<Measurement> measure_keypoints(const Camera& camera, const CameraMotion& motion,
                                           const FrameFeatures& features);

/// The same for measurements whose `seen` and `scale` are known: the motion is known better now.
void measure_again(const Camera& camera, const CameraMotion& motion, const FrameFeatures& features,
                   std::vector<Measurement>& measurements);

/// A frame that is kept in the map.
struct Keyframe {
  KeyframeId id;
  int frame = 0;                                  ///< index of the input frame
  double timestamp = 0;                           ///< [s]
  Pose cam_from_world;                            ///< when the middle row was read
  CameraMotion motion;                            ///< about that pose
  std::shared_ptr<const FrameFeatures> features;  ///< immutable, hence shared with the frame it was made of
  std::vector<LandmarkId> landmarks;              ///< per keypoint; invalid: none
  std::vector<Measurement> measurements;          ///< per keypoint
  std::vector<Covisible> covisible;               ///< most shared first, then by id
  MapId map{0};                                   ///< to which it belongs
  KeyframeId parent;                              ///< in the map's spanning tree; invalid for its root
  std::vector<KeyframeId> loops;                  ///< at the other ends of its loop edges, by id
};

}  // namespace stdc
