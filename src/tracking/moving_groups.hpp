#pragma once

#include <cstdint>
#include <vector>

#include "estimation/sensor_model.hpp"
#include "tracking/frame_matching.hpp"
#include "tracking/group_noise.hpp"
#include "tracking/tracked_frame.hpp"

namespace stdc {

/// Finds matches that agree with their neighbours but not with what the others say about the pose: keypoints
/// near to each other in the image and in depth. Each may be within the gate of the pose optimisation, and
/// ten of them on a box nearby, which say more about the position than hundreds on the wall behind, then pull
/// the pose by centimetres when the box begins to move.
///
/// A group is judged by its deleted residual, that from a pose found without it, which follows from the
/// group's leverage alone (Cook and Weisberg, Residuals and Influence in Regression, 1982, ch. 2). That a
/// region's residuals are consistent marks what moves (Jaimez et al., 'Fast Odometry and Scene Flow from
/// RGB-D Cameras', ICRA 2017).
/// @param frame    with its pose and the information of that
/// @param inliers  matches that the pose was found from
/// @param noise    how far groups were off of late; takes note of this frame's
/// @returns per match 1 if it belongs to a group that moves; all 0 if most would: which party rests cannot be
///          told from the matches alone
std::vector<std::uint8_t> find_moving_groups(const SensorModel& sensor, const TrackedFrame& frame,
                                             const std::vector<FrameMatch>& inliers, GroupNoise& noise);

/// How sure it is that a match belongs to a group that contradicts a pose.
enum class Contradiction : std::uint8_t { none, likely, sure };

/// Finds groups of matches that contradict a pose found without them. Unlike above, the more they contradict
/// it the less they count, however many they are: for matches to what entered the map last.
/// @param frame       its pose and measurements
/// @param covariance  of that pose
/// @returns per match whether it belongs to such a group
std::vector<Contradiction> find_contradicting_groups(const SensorModel& sensor, const TrackedFrame& frame,
                                                     const Matrix6d& covariance,
                                                     const std::vector<FrameMatch>& matches);

}  // namespace stdc
