#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core/mat.hpp>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "core/rgbd_image.hpp"

namespace stdc::test {

/// A camera of 160 x 120 pixels before a wall in the plane z = 2 m of the world, painted with smooth waves,
/// and a square that moves in front of it, 1 m away.
struct PlaneScene {
  static constexpr float kWall = 2, kMover = 1;  ///< [m]

  static Camera camera() {
    Camera camera;
    camera.width = 160, camera.height = 120;
    camera.fx = camera.fy = 150, camera.cx = 79.5, camera.cy = 59.5;
    return camera;
  }
  /// The camera at x [m], y = z = 0, looking along z.
  static Pose world_from_cam(double x) { return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0, 0)}; }
  /// Brightness of the wall at a point of it [m].
  static double paint(double x, double y, int channel) {
    return 120 + 40 * std::sin(9 * x + channel) + 40 * std::cos(11 * y - channel) +
           15 * std::sin(31 * (x + y));
  }

  /// @param mover     columns and rows that it covers; empty: none
  /// @param exposure  the brightness is multiplied by it
  static RgbdImage image(double x, cv::Rect mover = {}, double exposure = 1) {
    const Camera c = camera();
    RgbdImage image;
    image.colour.create(c.height, c.width, CV_8UC3);
    image.depth = cv::Mat(c.height, c.width, CV_16UC1, cv::Scalar(kWall * c.depth_units_per_metre));
    for (int v = 0; v < c.height; ++v) {
      for (int u = 0; u < c.width; ++u) {
        const Eigen::Vector3d p = c.unproject({u, v}, kWall);
        for (int i = 0; i < 3; ++i) {
          image.colour.at<cv::Vec3b>(v, u)[i] =
              cv::saturate_cast<std::uint8_t>(exposure * paint(p.x() + x, p.y(), i));
        }
      }
    }
    if (!mover.empty()) {
      image.colour(mover) = cv::Scalar(20, 20, 250);
      image.depth(mover) = kMover * c.depth_units_per_metre;
    }
    return image;
  }
  static cv::Mat mask(cv::Rect mover) {
    cv::Mat mask(camera().height, camera().width, CV_8UC1, cv::Scalar(0));
    if (!mover.empty()) mask(mover) = 255;
    return mask;
  }
};

}  // namespace stdc::test
