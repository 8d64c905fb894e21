#pragma once

#include <cstdint>
#include <vector>

#include "core/camera.hpp"
#include "tracking/frame_matching.hpp"
#include "tracking/tracked_frame.hpp"

namespace stdc {

/// Finds matches that agree with their neighbours but not with the frame's pose: keypoints near to each other
/// in the image and in depth, whose residuals all point the same way. Each may be within the gate of the pose
/// optimisation, and a hundred of them on something that has just begun to move then pull the pose by
/// centimetres; together they are beyond doubt. (Residuals that are consistent within a region as a sign of
/// motion: Jaimez et al., 'Fast Odometry and Scene Flow from RGB-D Cameras', ICRA 2017.)
/// @returns per match 1 if it belongs to a group that moves; all 0 if most would: which party rests cannot be
///          told from the matches alone
std::vector<std::uint8_t> find_moving_groups(const Camera& camera, const TrackedFrame& frame,
                                             const std::vector<FrameMatch>& matches);

}  // namespace stdc
