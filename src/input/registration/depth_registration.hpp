#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "input/registration/lens_rows.hpp"
#include "input/rgbd_cameras.hpp"

namespace stdc {

/// Brings depth images of another camera to the pixels of the colour camera. Each depth pixel is a small
/// rectangle that is projected into the colour image; the nearest one that covers the middle of a colour
/// pixel gives its depth, so what stands in front hides what is behind. Where the depth camera saw nothing
/// the depth is missing: holes are not filled. The same input gives the same bytes.
class DepthRegistration {
 public:
  /// Both cameras must be valid (Camera::validate).
  DepthRegistration(const DepthCamera& depth, const Camera& colour);

  /// @param depth  CV_16UC1 in units or CV_32FC1 in metres, of the depth camera's size
  /// @returns the same type, of the colour camera's size: depth along the colour camera's axis
  cv::Mat apply(const cv::Mat& depth) const;

 private:
  struct Row;  ///< of the depth image, on its way

  void set_sides(const std::vector<Eigen::Vector3d>& rays);
  template <typename T>
  cv::Mat register_all(const cv::Mat& depth) const;
  template <typename T>
  void project(const T* depth, int row, Row& out) const;

  cv::Size depth_size_, colour_size_;
  float units_;  ///< of 16-bit depth [1/m]
  /// A depth pixel at z metres is at z * ray + translation in the colour camera, both in homogeneous pixels.
  std::vector<float> ray_x_, ray_y_, ray_z_;
  std::array<float, 3> translation_{};
  std::vector<std::uint8_t> half_width_, half_height_;  ///< of a depth pixel in the colour image [px / 32]
  LensRows lens_;                                       ///< of the colour camera
};

}  // namespace stdc
