#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "input/rgbd_cameras.hpp"

namespace stdc {

/// How far the raw pixel of a camera lies from the ideal one, on a grid over its ideal pixels, for whoever
/// needs many of them: exact to about 0.01 px.
class LensTable {
 public:
  LensTable() = default;
  explicit LensTable(const Camera& camera);
  bool empty() const { return rows_ == 0; }
  /// Moves an ideal pixel to its raw one; false outside what the camera shows.
  bool distort(float& u, float& v) const;

 private:
  float left_ = 0, top_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<float> shift_x_, shift_y_;
};

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
  /// A row of the depth image in the colour image: ideal pixels, and depths [m], <= 0 where there is none.
  struct ProjectedRow {
    std::vector<float> u, v, z;
  };

  void set_sides(const std::vector<Eigen::Vector3d>& rays);
  template <typename T>
  cv::Mat register_all(const cv::Mat& depth) const;
  template <typename T>
  void project(const T* depth, int row, ProjectedRow& projected) const;
  template <typename T>
  void draw(const ProjectedRow& projected, const T* depth, int row, cv::Mat& registered) const;

  cv::Size depth_size_, colour_size_;
  float units_;  ///< of 16-bit depth [1/m]
  /// A depth pixel at z metres is at z * ray + translation in the colour camera, both in homogeneous pixels.
  std::vector<float> ray_x_, ray_y_, ray_z_;
  std::array<float, 3> translation_{};
  std::vector<std::uint8_t> half_width_, half_height_;  ///< of a depth pixel in the colour image [px / 32]
  LensTable lens_;                                      ///< of the colour camera; empty: a pinhole
};

}  // namespace stdc
