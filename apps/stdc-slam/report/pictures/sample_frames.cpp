#include "report/pictures/sample_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/images/image_codec.hpp"
#include "report/pictures/mask_overlay.hpp"
#include "report/result_text.hpp"

namespace stdc::app {
namespace {

constexpr int kRegular = 9;
constexpr std::size_t kFailed = 4;
constexpr int kWidth = 400;   // of a picture [px]
constexpr int kQuality = 78;  // of its JPEG
constexpr std::size_t kMaxBytes = 60000;
constexpr int kPixelStep = 8;  // every so many rows and columns are looked at for depth

double dynamic_share(const TrackingResult& result) {
  const double people = result.segmentation ? result.segmentation->dynamic_share : 0;
  return std::max(people, result.motion ? result.motion->dynamic_share : 0);
}

std::string describe_sample(const TrackingResult& result) {
  std::string text =
      result.status == TrackingStatus::ok ? "" : std::string(status_name(result.status)) + ", ";
  text += fmt::format("{} inliers", result.inliers);
  if (result.segmentation || result.motion)
    text += fmt::format(", {:.0f} % dynamic", 100 * dynamic_share(result));
  return result.is_keyframe ? text + ", keyframe" : text;
}

/// Keypoints that agree with the pose, and those that do not: told apart also by those who do not see red and
/// green.
void draw_keypoints(cv::Mat& picture, const FrameView& view, double factor) {
  const cv::Scalar inlier(255, 220, 60), outlier(40, 110, 255);
  constexpr int kFraction = 4;  // fraction bits of OpenCV's drawing coordinates
  for (std::size_t i = 0; i < view.keypoints.size(); ++i) {
    if (view.states[i] == KeypointState::unmatched) continue;
    const auto fixed = [&](float v) { return cvRound(((v + 0.5F) * factor - 0.5F) * (1 << kFraction)); };
    const cv::Point at(fixed(view.keypoints[i].x), fixed(view.keypoints[i].y));
    cv::circle(picture, at, 3 << (kFraction - 1), view.states[i] == KeypointState::inlier ? inlier : outlier,
               cv::FILLED, cv::LINE_AA, kFraction);
  }
}

/// What kept keypoints out, whatever the cause; empty: nothing.
cv::Mat mask_of(const FrameView& view) {
  if (view.segmented.empty() || view.moving.empty())
    return view.segmented.empty() ? view.moving : view.segmented;
  return view.segmented | view.moving;
}

/// The picture with its mask and keypoints; worse where it would be large.
std::vector<std::uint8_t> picture(const cv::Mat& colour, const FrameView& view) {
  const double factor = std::min(1.0, static_cast<double>(kWidth) / colour.cols);
  const cv::Size size(std::max(1, static_cast<int>(std::lround(colour.cols * factor))),
                      std::max(1, static_cast<int>(std::lround(colour.rows * factor))));
  cv::Mat small, small_mask(size, CV_8UC1, cv::Scalar(0));
  cv::resize(colour, small, size, 0, 0, cv::INTER_AREA);
  if (const cv::Mat mask = mask_of(view); !mask.empty())
    cv::resize(mask, small_mask, size, 0, 0, cv::INTER_NEAREST);
  small = draw_overlay(small, small_mask);
  draw_keypoints(small, view, factor);
  std::vector<std::uint8_t> jpeg = encode_jpeg(small, kQuality);
  return jpeg.size() > kMaxBytes ? encode_jpeg(small, kQuality / 2) : jpeg;
}

}  // namespace

SampleFrames::SampleFrames(Slam& slam, std::optional<int> expected) : slam_(slam) {
  if (expected) every_ = std::max(1, (*expected + kRegular - 1) / kRegular);
}

/// Every n-th frame; n grows where there are more frames than expected.
bool SampleFrames::is_regular(int index) {
  if (index % every_ != 0) return false;
  if (std::ssize(regular_) < kRegular) return true;
  every_ *= 2;
  std::vector<SampleFrame> kept;
  for (std::size_t i = 0; i < regular_.size(); i += 2) kept.push_back(std::move(regular_[i]));
  regular_ = std::move(kept);
  return index % every_ == 0;
}

void SampleFrames::on_frame(const ObservedFrame& frame) {
  const TrackingResult& result = frame.result;
  const TrackingStatus last = std::exchange(last_, result.status);
  if (frame.image == nullptr) return;
  const bool fails = result.status == TrackingStatus::uncertain || result.status == TrackingStatus::lost;
  const double share = dynamic_share(result);
  if (is_regular(result.frame)) {
    regular_.push_back(sample(frame));
    look_at_depth(frame.image->depth);
  } else if (fails && last != result.status && failed_.size() < kFailed) {
    failed_.push_back(sample(frame));
  } else if (share > 0.1 && share > 1.2 * most_dynamic_) {
    most_dynamic_ = share;
    busiest_ = sample(frame);
  }
}

SampleFrame SampleFrames::sample(const ObservedFrame& frame) {
  return {frame.number, frame.result.timestamp, describe_sample(frame.result),
          picture(frame.image->colour, slam_.last_frame())};
}

void SampleFrames::look_at_depth(const cv::Mat& depth) {
  in_metres_ = depth.type() == CV_32FC1;
  for (int y = 0; y < depth.rows; y += kPixelStep) {
    for (int x = 0; x < depth.cols; x += kPixelStep) {
      const double value = in_metres_ ? depth.at<float>(y, x) : depth.at<std::uint16_t>(y, x);
      ++pixels_;
      saturated_ += !in_metres_ && value == 65535 ? 1 : 0;
      if (value > 0) depths_.push_back(value);
    }
  }
}

std::vector<SampleFrame> SampleFrames::frames() const {
  std::vector<SampleFrame> all = regular_;
  all.insert(all.end(), failed_.begin(), failed_.end());
  if (busiest_) all.push_back(*busiest_);
  std::sort(all.begin(), all.end(),
            [](const SampleFrame& a, const SampleFrame& b) { return a.number < b.number; });
  return all;
}

std::optional<DepthLook> SampleFrames::depth() const {
  if (pixels_ == 0) return std::nullopt;
  DepthLook look;
  std::vector<double> depths = depths_;
  const auto quantile = [&](double share) {
    const auto at = depths.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(depths.size()));
    std::nth_element(depths.begin(), at, depths.end());
    return *at;
  };
  if (!depths.empty()) {
    look.median = quantile(0.5);
    look.far = quantile(0.95);
  }
  look.valid_share = static_cast<double>(depths_.size()) / static_cast<double>(pixels_);
  look.saturated_share = static_cast<double>(saturated_) / static_cast<double>(pixels_);
  return look;
}

}  // namespace stdc::app
