#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera.hpp"
#include "motion/motion_detector.hpp"

namespace stdc::test {

/// A rectangle that faces the world's z axis, with a texture of its own.
struct Panel {
  double left = 0, right = 0, top = 0, bottom = 0, z = 1;  ///< world [m]
  unsigned seed = 1;
  double slide = 0;  ///< the texture has moved by so much to the right [m]
};

/// Scenes of panels before a textured wall at 3 m, seen exactly.
struct WallScene {
  Camera camera;
  std::vector<Panel> panels;  ///< the nearer ones must not touch the farther ones in depth

  WallScene();
  /// Draws what a camera without rotation sees from `centre` [m].
  void draw(const Eigen::Vector3d& centre, cv::Mat& grey, cv::Mat& depth) const;
  /// 255 where a panel is seen, CV_8UC1.
  cv::Mat panel_mask(const Eigen::Vector3d& centre) const;
};

/// Feeds a detector with frames of such a scene, 30 a second, with true poses.
struct WallRun {
  WallScene scene;
  MotionDetector& detector;
  int frame = 0;
  cv::Mat segmented;  ///< what a segmenter says of the next frames; empty: there is none
  std::vector<LandmarkId> gone;

  explicit WallRun(MotionDetector& motion_detector) : detector(motion_detector) {}
  /// One frame, from a camera at `centre`; without depth where `hole` is not 0.
  void see(const Eigen::Vector3d& centre = Eigen::Vector3d::Zero(), const cv::Mat& hole = {});
};

}  // namespace stdc::test
