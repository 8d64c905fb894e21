#pragma once

#include <Eigen/Core>
#include <opencv2/core/types.hpp>
#include <string>

#include "input/rgbd_cameras.hpp"

namespace stdc {

/// What ScanNet says of its cameras, in intrinsic/ or in the head of a .sens file.
struct ScanNetCalibration {
  Eigen::Matrix4d colour_intrinsic, colour_extrinsic, depth_intrinsic, depth_extrinsic;
  cv::Size colour_size, depth_size;
  double depth_units_per_metre = 1000;
};

/// Throws Error naming `where` for what cannot be a camera.
RgbdCameras scannet_cameras(const ScanNetCalibration& calibration, const std::string& where);

}  // namespace stdc
