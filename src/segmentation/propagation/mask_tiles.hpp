#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "segmentation/propagation/propagation_frame.hpp"

namespace stdc {

/// A square of 2 x 2 cells of a mask, moved from frame to frame.
struct MaskTile {
  static constexpr int kSide = 2;       ///< [cells]
  static constexpr float kUnknown = 0;  ///< depth that is not known

  int x = 0, y = 0;                                    ///< its first cell in the frame of the mask
  Eigen::Vector2f shift = Eigen::Vector2f::Zero();     ///< to where it is now [cells]
  Eigen::Vector2f velocity = Eigen::Vector2f::Zero();  ///< [cells per frame]
  float depth = kUnknown;                              ///< expected [m]
  bool measured = false;  ///< the last step followed points on it; else it was taken to stand still

  /// Its middle now [cells].
  Eigen::Vector2f middle() const {
    return Eigen::Vector2f(static_cast<float>(x), static_cast<float>(y)) +
           Eigen::Vector2f::Constant(0.5F * (kSide - 1)) + shift;
  }
};

/// The tiles of a mask in its own frame: those with any dynamic pixel, row by row. A tile's depth is that of
/// its dynamic pixels; at the rim, where a mask may reach onto the background or show too little to tell,
/// that of the body beside it.
/// @param mask  CV_8UC1, not zero = dynamic, of the size that `frame` was made from
std::vector<MaskTile> make_tiles(const cv::Mat& mask, const SmallFrame& frame);

}  // namespace stdc
