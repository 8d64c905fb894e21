#pragma once

#include <opencv2/core/mat.hpp>

namespace stdc {

/// Guesses the depth where there is none, so that colour can be carried to another view: sensors are blind
/// beyond their range, beside near edges and on dark things. The guess is smooth, and leans to the far side
/// of an edge, because shadows of the sensor and what is out of range lie behind. By a pyramid that
/// is filled from the coarse level to the fine one (pull-push: Gortler et al., 'The Lumigraph', 1996, 3.4).
/// @param depth  CV_32FC1 [m], <= 0: missing; all filled in place unless nothing is known
void complete_depth(cv::Mat& depth);

}  // namespace stdc
