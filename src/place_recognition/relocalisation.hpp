#pragma once

#include <optional>
#include <vector>

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "estimation/pose_optimisation.hpp"
#include "tracking/tracking_settings.hpp"

namespace stdc {

/// Where a keyframe puts a frame that is not known to be anywhere near.
struct Relocalisation {
  Pose cam_from_world;
  std::vector<LandmarkId> landmarks;  ///< per keypoint of the frame: those that agree
};

/// Matches a frame to the landmarks of a keyframe by descriptor alone, finds a pose by RANSAC on 3D-3D
/// alignments of three points (Arun et al., PAMI 1987; Fischler and Bolles, CACM 1981) and optimises it.
/// Nothing if fewer than `min_inliers` agree. Same input, same result: the draws are seeded by the
/// keyframe.
std::optional<Relocalisation> locate_by_keyframe(const Camera& camera, const Atlas& atlas,
                                                 KeyframeId keyframe, const FrameFeatures& frame,
                                                 int min_inliers, const TrackingSettings& settings,
                                                 const NoiseSettings& noise,
                                                 const PoseOptimisationSettings& optimisation);

}  // namespace stdc
