#pragma once

#include <array>
#include <opencv2/core/types.hpp>
#include <span>

#include "features/keypoint.hpp"

namespace stdc {

/// Numbers of keypoints in the ten regions of five splits of the image: left and right, top and bottom, the
/// two sides of each diagonal, centre and periphery. The centre is the rectangle in the middle that has the
/// shape of the image and half of its area, so that the regions of every split are of the same size. A
/// keypoint on a dividing line belongs to the second region.
std::array<int, 10> region_counts(std::span<const Keypoint> keypoints, cv::Size image_size);

/// Uniformity of a distribution of keypoints, U = 101 log10(V), where V is the variance of the ten region
/// counts: the larger, the less uniform. 0 where V < 1. Source: Zhu, Wu and Xu, Seed point selection method
/// for triangle constrained image matching propagation, IEEE Geoscience and Remote Sensing Letters 3(2),
/// 2006, as used for Table 2 of the STDC-SLAM paper.
double uniformity(std::span<const Keypoint> keypoints, cv::Size image_size);

}  // namespace stdc
