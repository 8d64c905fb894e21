#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "simulation/light/ray_scene.hpp"

namespace stdc::simulation {

/// The image of perfect sensors, before noise. Images have the camera's size.
struct IdealImage {
  cv::Mat colour;  ///< CV_32FC3, linear red green blue
  cv::Mat depth;   ///< CV_32FC1, z at the pixel's centre [m]; 0: no surface
  cv::Mat
      infrared;   ///< CV_32FC1, share of the depth sensor's pattern that comes back (material, angle), 0..1
  cv::Mat mask;   ///< CV_8UC1, 255: a moving person or object at the pixel's centre
  cv::Mat moved;  ///< CV_8UC1, 255: a person or object there that moves now or at another time
};

}  // namespace stdc::simulation
