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
  std::vector<double> class_shares;  ///< of its pixels, by dynamic class; empty if there is only one
};

/// The table of segments.csv: a line for each image.
/// @param classes  names of the dynamic classes whose shares the images tell
std::string segments_csv(const std::vector<SegmentedImage>& images,
                         const std::vector<std::string>& classes = {});
/// Times and scores over all images, some lines of text.
std::string segment_summary(const std::vector<SegmentedImage>& images,
                            const std::vector<std::string>& classes = {});

}  // namespace stdc::app
