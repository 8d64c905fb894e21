#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace stdc {

/// A depth image as 16-bit PNGs hold it: metres (CV_32FC1) become units, CV_16UC1 stays as it is.
/// @param too_far  added to: depths that 16 bits cannot hold; they are missing in the result
cv::Mat depth_in_units(const cv::Mat& depth, double units_per_metre, std::int64_t& too_far);

}  // namespace stdc
