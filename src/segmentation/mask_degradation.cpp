#include "segmentation/mask_degradation.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/random.hpp"

namespace stdc {
namespace {

cv::Mat disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

void make_holes(cv::Mat& mask, int frame, const MaskDegradationSettings& settings) {
  std::vector<cv::Point> dynamic;
  cv::findNonZero(mask, dynamic);
  if (dynamic.empty()) return;
  Random random(static_cast<std::uint64_t>(settings.seed), static_cast<std::uint64_t>(frame) + 1);
  for (int i = 0; i < settings.holes; ++i) {
    const cv::Point centre = dynamic[random.below(static_cast<std::uint32_t>(dynamic.size()))];
    const int min_radius = (settings.hole_radius + 1) / 2;
    const auto choices = static_cast<std::uint32_t>(settings.hole_radius - min_radius + 1);
    cv::circle(mask, centre, min_radius + static_cast<int>(random.below(choices)), cv::Scalar(0), cv::FILLED);
  }
}

}  // namespace

cv::Mat degrade(const cv::Mat& mask, int frame, const MaskDegradationSettings& settings) {
  if (mask.empty()) return {};
  if (settings.missing_every > 0 && frame % settings.missing_every == settings.missing_every - 1) return {};
  cv::Mat result = mask != 0;
  if (settings.erosion > 0) cv::erode(result, result, disc(settings.erosion));
  if (settings.holes > 0) make_holes(result, frame, settings);
  return result;
}

DegradedSegmenter::DegradedSegmenter(std::unique_ptr<Segmenter> segmenter,
                                     const MaskDegradationSettings& settings)
    : segmenter_(std::move(segmenter)), settings_(settings) {
  check_ranges("degradation", settings_);
}

cv::Mat DegradedSegmenter::segment(const SegmenterInput& input) {
  late_.push_back(degrade(segmenter_->segment(input), input.frame, settings_));
  if (static_cast<int>(late_.size()) <= settings_.delay) return {};
  cv::Mat mask = std::move(late_.front());
  late_.pop_front();
  return mask;
}

}  // namespace stdc
