#pragma once

#include <memory>

#include "core/orientation.hpp"
#include "segmentation/segmenter.hpp"

namespace stdc {

/// Shows a segmenter the images of a turned camera upright, and turns its masks back: networks know people
/// as they stand.
class UprightSegmenter final : public Segmenter {
 public:
  UprightSegmenter(std::unique_ptr<Segmenter> segmenter, Orientation orientation)
      : segmenter_(std::move(segmenter)), orientation_(orientation) {}

  /// The mask lies on the pixels of the image as it was given.
  cv::Mat segment(const SegmenterInput& input) override;
  int delay() const override { return segmenter_->delay(); }

 private:
  std::unique_ptr<Segmenter> segmenter_;
  Orientation orientation_;
};

}  // namespace stdc
