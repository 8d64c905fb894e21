#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "simulation/light/ray_scene.hpp"

namespace stdc {

/// What one exposure of a perfect camera sees, before the sensors add their faults. Images have the camera's
/// size.
struct IdealImage {
  cv::Mat colour;    ///< CV_32FC3, linear red green blue
  cv::Mat depth;     ///< CV_32FC1, z at the pixel's centre [m]; 0: nothing there
  cv::Mat infrared;  ///< CV_32FC1, how well the depth sensor's pattern returns: material times angle, 0..1
  cv::Mat mask;      ///< CV_8UC1, 255: a moving thing at the pixel's centre
};

}  // namespace stdc
