#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "input/ground_truth.hpp"
#include "input/recordings/recording.hpp"
#include "input/recordings/transform_tree.hpp"

namespace stdc {

/// Collects the poses of a topic (PoseStamped, Odometry, TransformStamped) as a ground truth, in any order.
class RecordedTruth {
 public:
  void take(const RecordedTopic& topic, Bytes message);
  /// The trajectory of the camera. Where messages say what moves and `transforms` says how the camera stands
  /// to it, the poses are moved there; else they are taken to be those of the camera.
  /// @param camera_frame  of the colour images
  GroundTruth trajectory(const TransformTree& transforms, const std::string& camera_frame) const;
  /// Whether transforms can make a difference.
  bool names_what_moves() const { return !child_.empty(); }

 private:
  struct Row {
    std::int64_t stamp;
    Pose pose;
  };
  std::vector<Row> rows_;
  std::string child_;  ///< what moves, as the first message says
  GroundTruth counts_;
};

/// Reads a topic of poses, or one of TFMessage: of that the transforms from the tree's root to what carries
/// the camera, as in TUM's bags. Starts the recording anew.
GroundTruth read_recorded_truth(Recording& recording, int topic, const std::string& camera_frame);

}  // namespace stdc
