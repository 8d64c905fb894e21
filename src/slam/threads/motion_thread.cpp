#include "slam/threads/motion_thread.hpp"

#include <opencv2/core.hpp>
#include <utility>

#include "core/stopwatch.hpp"
#include "motion/make_motion_detector.hpp"

namespace stdc {

MotionThread::MotionThread(const Camera& camera, const MotionSettings& settings,
                           const PropagationSettings& propagation, bool draws_doubtful)
    : motion_(make_motion_detector(camera, settings)),
      draws_doubtful_(draws_doubtful),
      propagator_(camera, propagation) {}

void MotionThread::begin(const cv::Mat& depth, const cv::Mat& grey, int frame,
                         const std::optional<Pose>& frame_from_last) {
  worker_.wait();
  depth_ = depth.empty() ? cv::Mat(grey.size(), CV_16UC1, cv::Scalar(0)) : depth;
  grey_ = grey;
  frame_ = frame;
  worker_.start([this, frame_from_last] {
    Stopwatch watch;
    propagator_.add_frame(frame_, grey_, depth_, frame_from_last);
    expected_ = propagator_.has_mask() ? propagator_.mask() : cv::Mat();
    carrying_ms_ = watch.lap_ms();
  });
}

cv::Mat MotionThread::expected() {
  worker_.wait();
  return expected_;
}

std::optional<PoseAgreement> MotionThread::agreement(const Pose& cam_from_world, MapId map) const {
  return motion_->agreement(cam_from_world, map, propagator_.newest(), depth_, expected_);
}

void MotionThread::observe(MotionFrame frame) {
  worker_.wait();
  frame.number = frame_;
  frame.grey = grey_;
  frame.depth = depth_;
  worker_.start([this, frame = std::move(frame)] {
    Stopwatch watch;
    const std::vector<LandmarkId> gone = motion_->observe(frame, propagator_.newest(), propagator_.tiles());
    gone_.insert(gone_.end(), gone.begin(), gone.end());
    found_ = motion_->mask();
    moving_now_ = motion_->moving_now(found_);
    propagator_.set_mask(frame_, found_);
    if (draws_doubtful_) doubtful_ = motion_->doubtful();
    milliseconds_ = carrying_ms_ + watch.lap_ms();
  });
}

cv::Mat MotionThread::doubtful() {
  worker_.wait();
  return draws_doubtful_ ? doubtful_ : motion_->doubtful();
}

const cv::Mat& MotionThread::moving_now() {
  worker_.wait();
  return moving_now_;
}

const cv::Mat& MotionThread::found() {
  worker_.wait();
  return found_;
}

}  // namespace stdc
