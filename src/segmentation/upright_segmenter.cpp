#include "segmentation/upright_segmenter.hpp"

namespace stdc {

cv::Mat UprightSegmenter::segment(const SegmenterInput& input) {
  const cv::Mat mask =
      segmenter_->segment({to_upright(input.colour, orientation_), input.timestamp, input.frame});
  return mask.empty() ? mask : from_upright(mask, orientation_);
}

}  // namespace stdc
