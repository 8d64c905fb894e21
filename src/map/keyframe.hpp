#pragma once

#include <memory>
#include <vector>

#include "core/ids.hpp"
#include "core/pose.hpp"
#include "features/frame_features.hpp"

namespace stdc {

/// A keyframe that shares landmarks with another, and how many.
struct Covisible {
  KeyframeId keyframe;
  int shared = 0;
};

/// Where exactly a keypoint sees its landmark.
struct Measurement {
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  ///< ideal pixel
  float scale = 1;                                  ///< its noise is NoiseSettings::pixel_sigma times this
};

/// The keypoints' own positions, as extracted.
std::vector<Measurement> keypoint_measurements(const FrameFeatures& features);

/// A frame that is kept in the map.
struct Keyframe {
  KeyframeId id;
  int frame = 0;         ///< index of the input frame
  double timestamp = 0;  ///< [s]
  Pose cam_from_world;
  std::shared_ptr<const FrameFeatures> features;  ///< immutable, hence shared with the frame it was made of
  std::vector<LandmarkId> landmarks;              ///< per keypoint; invalid: none
  std::vector<Measurement> measurements;          ///< per keypoint
  std::vector<Covisible> covisible;               ///< most shared first, then by id
  KeyframeId parent;                              ///< in the spanning tree; invalid for the first
};

}  // namespace stdc
