#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "segmentation/network/logits.hpp"
#include "segmentation/network/network_weights.hpp"

namespace stdc {

/// How likely each pixel is of a dynamic class. The log-odds of each logit, log(sum of exp over the dynamic
/// classes) - log(sum of exp over the others), are upsampled bilinearly (half-pixel centres, the border
/// repeated) and calibrated. With two classes and an offset of 0, p > 0.5 is ClassMap's mask.
/// @param dynamic  [class]; at least one class is dynamic and one is not
/// @returns CV_32FC1, 0..1
cv::Mat draw_probabilities(const Logits& logits, cv::Size size, const std::vector<bool>& dynamic,
                           const ProbabilityCalibration& calibration);

}  // namespace stdc
