#pragma once

#include <deque>
#include <memory>

#include "core/setting.hpp"
#include "segmentation/segmenter.hpp"

namespace stdc {

/// How to degrade masks, to measure robustness against the errors of a network.
struct MaskDegradationSettings {
  STDC_SETTING(int, erosion, 0, "px", 0, 100, "Width removed all round the mask's border");
  STDC_SETTING(int, holes, 0, "count", 0, 1000, "Round holes made in each mask");
  STDC_SETTING(int, hole_radius, 15, "px", 1, 200, "Max radius of a hole; the min is half of it");
  STDC_SETTING(int, missing_every, 0, "frames", 0, 1000, "One mask in this many is missing; 0: none");
  STDC_SETTING(int, delay, 0, "frames", 0, 30, "A frame gets the mask of this many frames before");
  STDC_SETTING(int, seed, 1, "", 0, 1000000000, "Seed of the random holes");
  bool any() const { return erosion > 0 || holes > 0 || missing_every > 0 || delay > 0; }
};

/// A degraded copy of the mask of frame `frame`: eroded by a disc, with holes whose centres are dynamic
/// pixels drawn at random; empty if it is one of those to miss (frames n - 1, 2n - 1 ... of every n). The
/// delay is the caller's. The same mask, frame and settings give the same bytes.
/// @param mask  CV_8UC1, not zero = dynamic; empty stays empty
/// @returns CV_8UC1, 255 = dynamic
cv::Mat degrade(const cv::Mat& mask, int frame, const MaskDegradationSettings& settings);

/// A segmenter whose masks are degraded.
class DegradedSegmenter final : public Segmenter {
 public:
  /// Throws Error if a setting is out of range.
  DegradedSegmenter(std::unique_ptr<Segmenter> segmenter, const MaskDegradationSettings& settings);

  /// With a delay, the mask that was found so many calls ago, unmoved; empty until there is one. Else as
  /// degrade(); in both cases empty means that the frame is not segmented.
  cv::Mat segment(const SegmenterInput& input) override;
  int delay() const override { return segmenter_->delay() + settings_.delay; }

 private:
  std::unique_ptr<Segmenter> segmenter_;
  MaskDegradationSettings settings_;
  std::deque<cv::Mat> late_;
};

}  // namespace stdc
