#pragma once

#include <string>

#include "input/ground_truth.hpp"
#include "input/recordings/recording.hpp"
#include "input/recordings/transform_tree.hpp"

namespace stdc {

/// Reads a topic of poses (PoseStamped, Odometry, TransformStamped) as a ground truth, in any order. Where
/// the message says what moves and `transforms` says how the camera stands to it, the poses are those of the
/// camera; else they are taken to be. Starts the recording anew.
/// @param camera_frame  of the colour images
GroundTruth read_recorded_truth(Recording& recording, int topic, const TransformTree& transforms,
                                const std::string& camera_frame);

}  // namespace stdc
