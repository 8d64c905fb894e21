#pragma once

#include <deque>
#include <memory>

#include "core/setting.hpp"
#include "segmentation/segmenter.hpp"

namespace stdc {

/// How to degrade masks, to measure robustness against the errors of a network.
struct MaskDegradationSettings {
  int erosion = 0;
  int holes = 0;
  int hole_radius = 15;
  int missing_every = 0;
  int delay = 0;
  int seed = 1;

  template <typename Self, typename Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Setting{"erosion", "px", "Taken off the mask's border all round", 0, 100}, self.erosion);
    visit(Setting{"holes", "count", "Round holes made in each mask", 0, 1000}, self.holes);
    visit(Setting{"hole_radius", "px", "Largest radius of a hole; the smallest is half of it", 1, 200},
          self.hole_radius);
    visit(Setting{"missing_every", "frames", "One mask in so many is missing; 0: none", 0, 1000},
          self.missing_every);
    visit(Setting{"delay", "frames", "A frame is given the mask of so many frames before", 0, 30},
          self.delay);
    visit(Setting{"seed", "", "Of the holes", 0, 1000000000}, self.seed);
  }
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
