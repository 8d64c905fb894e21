#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera.hpp"
#include "core/camera_motion.hpp"
#include "segmentation/propagation/propagation_frame.hpp"

namespace stdc {

/// Where the cells of a depth grid look: about 160 x 120 rays of a camera without distortion.
/// The geometry of frames is compared on such grids, so that lenses and rolling shutters matter only when a
/// grid is sampled.
class GridGeometry {
 public:
  explicit GridGeometry(const Camera& camera);

  int width() const { return width_; }
  int height() const { return height_; }
  int size() const { return width_ * height_; }
  /// Of a cell in lists of all cells.
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(column);
  }
  int scale() const { return scale_; }  ///< side of a cell [raw px], about
  float focal_x() const { return focal_x_; }
  float focal_y() const { return focal_y_; }
  float centre_x() const { return centre_x_; }
  float centre_y() const { return centre_y_; }
  /// x / z of a column and y / z of a row.
  float ray_x(int column) const { return rays_x_[static_cast<std::size_t>(column)]; }
  float ray_y(int row) const { return rays_y_[static_cast<std::size_t>(row)]; }
  /// The cell that sees a point in the camera frame [m]; -1: none.
  int cell_of(const Eigen::Vector3f& point) const {
    constexpr float kMinDepth = 0.1F;
    if (!(point.z() > kMinDepth)) return -1;
    const float x = focal_x_ * point.x() / point.z() + centre_x_ + 0.5F;
    const float y = focal_y_ * point.y() / point.z() + centre_y_ + 0.5F;
    if (!(x >= 0 && y >= 0)) return -1;
    const int u = static_cast<int>(x), v = static_cast<int>(y);
    return u < width_ && v < height_ ? v * width_ + u : -1;
  }
  /// Raw pixel at the middle of each cell; outside of the image where the lens shows nothing there.
  const std::vector<Eigen::Vector2f>& raw_pixels() const { return raw_pixels_; }
  /// Cell that a square of `scale` raw pixels lies in, of all squares row by row; -1: none.
  const std::vector<int>& cell_of_square() const { return cell_of_square_; }

 private:
  int width_, height_, scale_;
  float focal_x_, focal_y_, centre_x_, centre_y_;
  std::vector<float> rays_x_, rays_y_;
  std::vector<Eigen::Vector2f> raw_pixels_;
  std::vector<int> cell_of_square_;
};

/// Depth of the cells [m], row by row; 0: missing. `near` and `far`: min and max of a cell and those around
/// it up to `reach` cells away, where the cell itself has a depth: a depth edge is known no better.
struct DepthGrid {
  std::vector<float> depth, near, far;
  int reach = 1;
  std::vector<std::uint8_t> grey;  ///< brightness of each cell; empty: not known

  void find_extremes(int width, int height);
};

/// Samples a depth image: the middle one of five depths in each cell. The rotation of the camera while a
/// rolling shutter read the image is taken out.
/// @param depth           CV_16UC1 or CV_32FC1, as in RgbdImage
/// @param time_tolerance  how far depth and pose may be apart in time [s]: widens `reach` while the camera
///                        turns
DepthGrid sample_grid(const GridGeometry& geometry, const Camera& camera, const CameraMotion& motion,
                      const cv::Mat& depth, double time_tolerance);
/// The brightness of the cells, of an image that was shrunk to squares of `scale` pixels.
std::vector<std::uint8_t> sample_grey(const GridGeometry& geometry, const SmallImage& squares);

}  // namespace stdc
