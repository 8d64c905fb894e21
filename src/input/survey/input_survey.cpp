#include "input/survey/input_survey.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/error.hpp"
#include "input/registration/depth_registration.hpp"

namespace stdc {
namespace {

constexpr double kGap = 2.5;  // intervals

/// The value at a share of a list, 0 if it is empty.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

double median(const std::vector<double>& values) { return quantile(values, 0.5); }

/// How far 95 % of the values are from `middle` at most.
double spread(std::vector<double> values, double middle) {
  for (double& value : values) value = std::abs(value - middle);
  return quantile(std::move(values), 0.95);
}

/// Gathers the times of frames.
class TimeTaker {
 public:
  /// @param depth_time_offset  of the camera file [s]
  explicit TimeTaker(double depth_time_offset) : depth_time_offset_(depth_time_offset) {}

  void add(const SourceFrame& frame) {
    if (frames_++ == 0) {
      times_.first = frame.timestamp;
    } else if (frame.timestamp > times_.last) {
      intervals_.push_back(frame.timestamp - times_.last);
      starts_.push_back(times_.last);
    } else {
      ++times_.backwards;
    }
    times_.last = std::max(frames_ == 1 ? frame.timestamp : times_.last, frame.timestamp);
    offsets_.push_back(frame.depth_timestamp + depth_time_offset_ - frame.timestamp);
  }

  SurveyTimes result() {
    times_.frames = frames_;
    times_.interval = median(intervals_);
    times_.jitter = spread(intervals_, times_.interval);
    for (std::size_t i = 0; i < intervals_.size(); ++i) {
      if (intervals_[i] < kGap * times_.interval) continue;
      ++times_.gaps;
      if (intervals_[i] <= times_.longest_gap) continue;
      times_.longest_gap = intervals_[i];
      times_.gap_at = starts_[i];
    }
    times_.depth_offset = median(offsets_);
    times_.depth_offset_spread = spread(offsets_, times_.depth_offset);
    return times_;
  }

 private:
  double depth_time_offset_;
  SurveyTimes times_;
  int frames_ = 0;
  std::vector<double> intervals_, starts_, offsets_;
};

/// Looks at the images of some frames.
class ImageTaker {
 public:
  explicit ImageTaker(const std::optional<RgbdCameras>& cameras) {
    if (cameras && cameras->depth) registration_.emplace(*cameras->depth, cameras->colour);
    if (!cameras) return;
    colour_size_ = cv::Size(cameras->colour.width, cameras->colour.height);
    const Camera& of_depth = cameras->depth ? cameras->depth->camera : cameras->colour;
    depth_size_ = cv::Size(of_depth.width, of_depth.height);
  }

  void add(const SourceFrame& frame) {
    try {
      add(frame.images->colour({}, ColourMode::as_stored), frame.images->depth({}));
    } catch (const Error& error) {
      if (images_.unreadable++ == 0) images_.first_problem = error.what();
    }
  }

  SurveyImages result() {
    images_.brightness = median(brightness_);
    images_.valid_share = median(valid_);
    images_.registered_share = median(registered_);
    images_.median_depth = median(depths_);
    images_.far_depth = quantile(depths_, 0.95);
    images_.saturated_share = pixels_ > 0 ? saturated_ / pixels_ : 0;
    images_.edges = alignment_.shift();
    images_.left_edges = alignment_.left_shift();
    images_.right_edges = alignment_.right_shift();
    return images_;
  }

 private:
  void add(const cv::Mat& colour, const cv::Mat& depth) {
    if (images_.sampled++ == 0) {
      images_.colour_size = colour.size();
      images_.depth_size = depth.size();
      images_.grey = colour.channels() == 1;
      images_.depth_in_metres = depth.type() == CV_32FC1;
    } else if (colour.size() != images_.colour_size || depth.size() != images_.depth_size) {
      ++images_.other_sizes;
      return;
    }
    const cv::Scalar mean = cv::mean(colour);
    brightness_.push_back(colour.channels() == 1 ? mean[0] : (mean[0] + mean[1] + mean[2]) / 3);
    add_depths(depth);
    const bool can_register = registration_ && depth.size() == depth_size_ && colour.size() == colour_size_;
    const cv::Mat registered = can_register ? registration_->apply(depth) : depth;
    registered_.push_back(share_of_depth(registered));
    if (registered.size() == colour.size()) alignment_.add(colour, registered);
  }

  static double share_of_depth(const cv::Mat& depth) {
    return cv::countNonZero(depth > 0) / std::max(1.0, static_cast<double>(depth.total()));
  }

  /// A depth of every few pixels will do.
  void add_depths(const cv::Mat& depth) {
    constexpr int kPixelStep = 7;
    valid_.push_back(share_of_depth(depth));
    for (int y = kPixelStep / 2; y < depth.rows; y += kPixelStep) {
      for (int x = kPixelStep / 2; x < depth.cols; x += kPixelStep) {
        const double value = depth.type() == CV_16UC1 ? depth.at<std::uint16_t>(y, x)
                                                      : static_cast<double>(depth.at<float>(y, x));
        ++pixels_;
        if (depth.type() == CV_16UC1 && value == 65535) ++saturated_;
        if (value > 0 && std::isfinite(value)) depths_.push_back(value);
      }
    }
  }

  SurveyImages images_;
  std::optional<DepthRegistration> registration_;
  cv::Size colour_size_, depth_size_;
  EdgeAlignment alignment_;
  std::vector<double> brightness_, valid_, registered_, depths_;
  double pixels_ = 0, saturated_ = 0;
};

}  // namespace

InputSurvey survey_input(FrameSource& source, const std::optional<RgbdCameras>& cameras, int max_sampled,
                         const std::function<void(int)>& progress) {
  InputSurvey survey;
  survey.kind = source.kind();
  survey.where = source.where();
  survey.streams = source.streams();
  survey.cameras = cameras ? cameras : source.cameras();
  survey.camera_hint = source.camera_hint();
  survey.truth_where = source.truth_where();
  TimeTaker times(survey.cameras ? survey.cameras->depth_time_offset : 0);
  ImageTaker images(survey.cameras);
  constexpr int kUsualLength =
      3000;  // [frames] where the length is not known: a longer one is sampled more often
  const int step =
      std::max(1, source.expected_frame_count().value_or(kUsualLength) / std::max(1, max_sampled));
  int frames = 0;
  while (const auto frame = source.next()) {
    times.add(*frame);
    survey.imu_samples += static_cast<int>(frame->imu.size());
    if (frames % step == 0) images.add(*frame);
    progress(++frames);
  }
  try {  // a recording has read it along with its frames
    survey.truth = source.ground_truth();
  } catch (const Error& error) {
    survey.truth_problem = error.what();
  }
  survey.times = times.result();
  survey.images = images.result();
  survey.colour_without_depth = source.colour_without_depth();
  survey.notes = source.notes();
  survey.faults = source.faults();
  return survey;
}

}  // namespace stdc
