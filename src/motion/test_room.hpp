#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "motion/motion_detector.hpp"
#include "segmentation/propagation/mask_propagator.hpp"

// A room for the tests of the motion methods: textured walls, a pillar close to the camera, and a box
// anywhere.

namespace stdc::test {

/// What the camera of a room sees.
struct RoomShot {
  cv::Mat grey, depth, mask;  ///< CV_8UC1; CV_16UC1, 5000 to the metre; CV_8UC1, 255 = box
};

/// A wall 3.5 m ahead of the origin, a floor 0.9 m below it, and, before the wall, a pillar that rests.
class Room {
 public:
  Camera camera;

  Room();
  /// @param box  its middle [m, world]; nothing: there is none. It is 0.6 m wide and 0.9 m high.
  RoomShot look(const Pose& cam_from_world, const std::optional<Eigen::Vector3d>& box = {}) const;

 private:
  cv::Mat texture_;
};

/// Shows a detector the frames of a room as the program does.
class RoomWatch {
 public:
  RoomWatch(MotionDetector& detector, const Camera& camera) : detector_(detector), propagator_(camera) {}

  /// The next frame. @returns the detector's mask
  cv::Mat show(const RoomShot& shot, const std::optional<Pose>& cam_from_world, bool is_keyframe = false,
               const cv::Mat& segmented = {});

 private:
  MotionDetector& detector_;
  MaskPropagator propagator_;
  int next_ = 0;
};

double share(const cv::Mat& mask);
double overlap(const cv::Mat& mask, const cv::Mat& truth);  ///< intersection over union

}  // namespace stdc::test
