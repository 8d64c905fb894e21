#pragma once

#include <vector>

#include "core/camera.hpp"
#include "estimation/pose_optimisation.hpp"
#include "estimation/sensor_model.hpp"
#include "tracking/local_map.hpp"
#include "tracking/tracked_frame.hpp"
#include "tracking/tracking_settings.hpp"

namespace stdc {

/// A keypoint of the frame and the point of the world that it sees: a landmark of the local map, or a
/// temporary point made of the last frame's depth.
struct FrameMatch {
  int keypoint = 0;
  int landmark = -1;                                   ///< index into LocalMap::landmarks; -1: temporary
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< world [m]
};

/// Matches the landmarks that the last frame saw around where the frame's predicted pose and motion put them,
/// with consistent rotations. Where they are few, points made of the last frame's other keypoints with depth
/// are matched too.
/// @param radius  search radius [px] on level 0; grows with the level's scale
std::vector<FrameMatch> match_last_frame(const Camera& camera, const LocalMap& local_map,
                                         const TrackedFrame& last, const TrackedFrame& frame, double radius,
                                         const TrackingSettings& settings);

/// Matches the reference keyframe's landmarks by descriptor alone, with consistent rotations.
std::vector<FrameMatch> match_reference(const LocalMap& local_map, const FrameFeatures& frame,
                                        const TrackingSettings& settings);

/// Matches the local map's landmarks that the camera should see and that are not matched yet.
/// @param matches      in, out: what is matched already; new matches are appended
/// @param visible      out: indices of landmarks that should be seen, those already matched included
/// @param radius       search radius [px] on level 0
void match_local_map(const Camera& camera, const LocalMap& local_map, const TrackedFrame& frame,
                     double radius, const TrackingSettings& settings, std::vector<FrameMatch>& matches,
                     std::vector<int>& visible);

/// Aligns the frame's image to the reference view of the matched landmarks: sets the measurements of those
/// keypoints where it succeeds.
void align_matches(const SensorModel& sensor, const LocalMap& local_map,
                   const std::vector<FrameMatch>& matches, TrackedFrame& frame);

/// The observations of these matches, for the pose optimisation.
std::vector<PoseObservation> make_observations(const TrackedFrame& frame,
                                               const std::vector<FrameMatch>& matches);

}  // namespace stdc
