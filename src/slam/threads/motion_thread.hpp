#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/camera.hpp"
#include "core/rgbd_image.hpp"
#include "motion/motion_detector.hpp"
#include "motion/motion_settings.hpp"
#include "segmentation/propagation/mask_propagator.hpp"
#include "slam/threads/worker.hpp"

namespace stdc {

/// Finds what moves beside the tracker. What moved in the last frame is carried to the present one while its
/// keypoints are detected; once the frame has a pose, its depth is compared with the map, beside whatever
/// comes next.
class MotionThread {
 public:
  /// @param draws_doubtful  doubtful() will be asked for after every frame: it is drawn beside the tracker
  MotionThread(const Camera& camera, const MotionSettings& settings, const PropagationSettings& propagation,
               bool draws_doubtful);

  /// Starts carrying what moved in the last frame to this one. Both images are kept and must not change; no
  /// depth: empty.
  void begin(const cv::Mat& depth, const cv::Mat& grey, int frame,
             const std::optional<Pose>& frame_from_last);
  /// What is expected to move in the frame of the last begin(), waiting for it: CV_8UC1, 255 = dynamic; empty
  /// if nothing is known.
  cv::Mat expected();
  /// Takes account of the keyframes' present poses; after expected(), before the two that follow.
  void follow(const AtlasSnapshot& snapshot) { motion_->follow(snapshot); }
  /// Starts to find what does move in it.
  /// @param frame  without its images and number, which are known
  void observe(MotionFrame frame);
  /// What does, waiting for it; like expected().
  const cv::Mat& found();
  /// The same without what stands still at present.
  const cv::Mat& moving_now();
  /// What found() gives and all that may move, of which no landmarks are to be made.
  cv::Mat doubtful();
  /// Share of what is known of the static scene that a pose of the present frame explains; see MotionReport.
  /// After expected(), before observe().
  std::optional<PoseAgreement> agreement(const Pose& cam_from_world, MapId map) const;
  /// Landmarks that the frames observed so far looked through, since the last call; after expected() or
  /// found().
  std::vector<LandmarkId> take_gone() { return std::exchange(gone_, {}); }
  /// Wall time of the work for the last frame that was observed; after expected() or found().
  double milliseconds() const { return milliseconds_; }

 private:
  std::unique_ptr<MotionDetector> motion_;
  bool draws_doubtful_;
  MaskPropagator propagator_;
  cv::Mat grey_, depth_;
  cv::Mat expected_, found_, moving_now_;
  cv::Mat doubtful_;  ///< if it is drawn each time
  int frame_ = 0;
  std::vector<LandmarkId> gone_;
  double carrying_ms_ = 0, milliseconds_ = 0;
  Worker worker_;  // last, so that it ends before what it works on
};

}  // namespace stdc
