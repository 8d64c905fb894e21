#include "run/masks/mask_scoring.hpp"

#include "segmentation/mask_file_segmenter.hpp"

namespace stdc::app {

void MaskScoring::on_frame(const ObservedFrame& frame) {
  const TrackingResult& result = frame.result;
  const MaskFile* file = find_mask(truth_, result.timestamp, MaskFileSegmenter::kTolerance);
  if (file == nullptr || result.dynamic_mask.empty()) return;
  score_.counts += count_mask(result.dynamic_mask, load_mask(*file, result.dynamic_mask.size()));
  ++score_.frames;
}

}  // namespace stdc::app
