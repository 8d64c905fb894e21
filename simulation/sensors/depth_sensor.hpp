#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/camera.hpp"

namespace stdc::simulation {

/// Model of a structured-light depth sensor such as the first Kinect, registered to colour: disparity in
/// steps of 1/8 pixel with noise, so that the error grows with z squared (Khoshelham and Elberink 2012),
/// jagged outlines (Handa et al. 2014), and holes: in the projector's shadow beside near objects, on dark,
/// glossy or grazing surfaces, nearer than 0.5 m and from about 5 m on.
class DepthSensor {
 public:
  explicit DepthSensor(const Camera& camera) : camera_(camera) {}

  /// @param depth     CV_32FC1, true z [m]; 0: no surface
  /// @param infrared  CV_32FC1, share of the pattern that comes back, 0..1
  /// @param seed      of the noise; use another for each frame
  /// @return CV_16UC1 in Camera::depth_units_per_metre; 0: missing
  cv::Mat image(const cv::Mat& depth, const cv::Mat& infrared, std::uint64_t seed) const;

 private:
  cv::Mat lit_by_projector(const cv::Mat& depth) const;

  Camera camera_;
};

}  // namespace stdc::simulation
