#pragma once

#include <string>
#include <vector>

#include "evaluation/mask_score.hpp"

namespace stdc::app {

/// What `segment` tells about one image.
struct SegmentedImage {
  std::string name;
  double dynamic_share = 0;          ///< of its pixels
  double wall_ms = 0, cpu_ms = 0;    ///< of segmenting it; CPU of the calling thread
  std::optional<MaskCounts> counts;  ///< against the truth
};

/// The table of segments.csv: a line for each image.
std::string segments_csv(const std::vector<SegmentedImage>& images);
/// Times and scores over all images, some lines of text.
std::string segment_summary(const std::vector<SegmentedImage>& images);

}  // namespace stdc::app
