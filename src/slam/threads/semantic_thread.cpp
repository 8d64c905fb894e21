#include "slam/threads/semantic_thread.hpp"

#include <opencv2/core.hpp>
#include <utility>

#include "core/error.hpp"
#include "core/stopwatch.hpp"
#include "segmentation/propagation/mask_settling.hpp"

namespace stdc {

SemanticThread::SemanticThread(const Camera& camera, const SegmentationSettings& settings,
                               const RefinementSettings& refinement, const PropagationSettings& propagation,
                               std::unique_ptr<Segmenter> segmenter)
    : settings_(settings),
      refinement_(refinement),
      depth_units_per_metre_(camera.depth_units_per_metre),
      segmenter_(std::move(segmenter)),
      propagator_(camera, propagation) {}

void SemanticThread::begin(const RgbdImage& image, const cv::Mat& grey, int frame,
                           const std::optional<Pose>& frame_from_last) {
  image_ = image;
  grey_ = grey;
  frame_ = frame;
  result_ = {};
  if (settings_.pace == SegmentationPace::every_frame) {
    if (!may_rest(image.timestamp)) segment(image, frame);
    last_time_ = image.timestamp;
    carrying_.start([this, frame_from_last] { move_mask(frame_from_last); });
    return;
  }
  if (in_flight_ && frame >= *in_flight_ + settings_.latency) collect();
  if (!in_flight_) segment(image, frame);
  // Before the first mask there is nothing to carry, and a map must not begin with people in it.
  if (mask_frame_ < 0) collect();
  carrying_.start([this, frame_from_last] {
    move_mask(frame_from_last);
    complete_mask();
  });
}

DynamicMask SemanticThread::finish() {
  carrying_.wait();
  if (settings_.pace == SegmentationPace::every_frame) {
    if (in_flight_) collect();
    complete_mask();
  }
  image_ = {};
  grey_.release();
  return std::move(result_);
}

/// True if nobody has been seen for a while and the next image comes early enough to find a newcomer in time.
bool SemanticThread::may_rest(double timestamp) const {
  if (settings_.source != SegmentationSource::network || settings_.idle_interval <= 0) return false;
  if (!empty_since_ || !last_time_ || timestamp - *empty_since_ < settings_.idle_after) return false;
  constexpr double kRounding = 1e-3;  // of times that are written as multiples of a period
  const double next = timestamp + (timestamp - *last_time_);
  return next <= segmented_time_ + settings_.idle_interval + kRounding;
}

void SemanticThread::segment(const RgbdImage& image, int frame) {
  in_flight_ = frame;
  segmented_time_ = image.timestamp;
  // The caller may reuse its buffer while the segmentation still runs.
  const bool outlives_frame = settings_.pace == SegmentationPace::asynchronous;
  SegmenterInput input{outlives_frame ? image.lasting(image.colour) : image.colour, image.timestamp, frame};
  segmenting_.start([this, input = std::move(input)] {
    Stopwatch watch;
    segmented_ = {input.frame, input.timestamp, {}, 0};
    segmented_.mask = segmenter_->segment(input);
    segmented_.milliseconds = watch.lap_ms();
  });
}

void SemanticThread::collect() {
  in_flight_.reset();
  try {
    segmenting_.wait();
  } catch (const Error& error) {
    result_.report.problem = error.what();
  }
  if (segmented_.mask.empty()) return;
  result_.report.segmentation_ms = segmented_.milliseconds;
  mask_ = segmented_.mask;
  if (cv::countNonZero(mask_) > 0) {
    empty_since_.reset();
  } else if (!empty_since_) {
    empty_since_ = segmented_.timestamp;
  }
  mask_frame_ = segmented_.frame - segmenter_->delay();
  mask_is_new_ = true;
}

/// Brings what was known at the frame before to this one.
void SemanticThread::move_mask(const std::optional<Pose>& frame_from_last) {
  if (!settings_.propagation) return;
  Stopwatch watch;
  const cv::Mat depth = image_.depth.empty() ? cv::Mat(grey_.size(), CV_16UC1, cv::Scalar(0)) : image_.depth;
  propagator_.add_frame(frame_, grey_, depth, frame_from_last);
  result_.report.propagation_ms = watch.lap_ms();
}

/// Takes account of the newest mask and completes what there is now by depth.
void SemanticThread::complete_mask() {
  if (mask_frame_ < 0) return;
  Stopwatch watch;
  if (settings_.propagation && mask_is_new_) propagator_.set_mask(mask_frame_, mask_);
  mask_is_new_ = false;
  cv::Mat mask = moved_mask();
  result_.report.propagation_ms += watch.lap_ms();
  const bool has_depth = !image_.depth.empty();
  // A rim of background claims the background around it.
  if (settings_.border_trimming && has_depth)
    mask = settle_by_depth(mask, image_.depth, depth_units_per_metre_);
  if (settings_.refinement && has_depth) {
    mask = refine(mask, image_.depth, depth_units_per_metre_, refinement_);
  }
  result_.report.refinement_ms = watch.lap_ms();
  result_.mask = mask;
  result_.report.mask_age = frame_ - mask_frame_;
  result_.report.dynamic_share =
      static_cast<double>(cv::countNonZero(mask)) / static_cast<double>(mask.total());
}

/// A mask that came too late to be carried is better than none.
cv::Mat SemanticThread::moved_mask() const {
  return settings_.propagation && propagator_.has_mask() ? propagator_.mask() : mask_;
}

}  // namespace stdc
