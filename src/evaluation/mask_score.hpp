#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

namespace stdc {

/// How a mask compares with the truth, as counts, so that they add up over images.
struct MaskCounts {
  std::int64_t both = 0, mask_only = 0, truth_only = 0;  ///< [px]
  /// Pixels of the mask's outline, and of them those near the truth's; and the other way round.
  std::int64_t mask_boundary = 0, mask_boundary_near = 0, truth_boundary = 0, truth_boundary_near = 0;

  MaskCounts& operator+=(const MaskCounts& other);
};

/// Each is nothing where it is not defined (0 / 0).
struct MaskScores {
  std::optional<double> iou;         ///< both / (both + mask_only + truth_only)
  std::optional<double> precision;   ///< both / (both + mask_only)
  std::optional<double> recall;      ///< both / (both + truth_only)
  std::optional<double> boundary_f;  ///< harmonic mean of the shares of the outlines that are near each other
};

/// Compares masks pixel by pixel and outline by outline. Two outlines are near each other within 0.8 % of the
/// image's diagonal (the contour measure F of Perazzi et al., 'A Benchmark Dataset and Evaluation Methodology
/// for Video Object Segmentation', CVPR 2016, with the threshold of its toolkit).
/// @param mask, truth  CV_8UC1 of one size, not 0 = dynamic
/// @param ignore       empty, or CV_8UC1 of that size: pixels that are not 0 count nowhere, nor do outlines
///                     near them
/// Throws Error if sizes or types differ.
MaskCounts count_mask(const cv::Mat& mask, const cv::Mat& truth, const cv::Mat& ignore = {});

MaskScores score_mask(const MaskCounts& counts);

/// The mean of each score over the images where it is defined.
MaskScores mean_scores(const std::vector<MaskScores>& scores);

}  // namespace stdc
