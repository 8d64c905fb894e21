#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/rgbd_image.hpp"

namespace stdc::test {

/// A textured board that faces the camera, pasted into frames of TestSequence::of_a_room() with its depth.
class Board {
 public:
  /// @param width, height [px]  @param depth [m]
  /// @param contrast  of the texture, 1 = the whole range; a weak one gives fewer keypoints than the room has
  Board(int width, int height, double depth, std::uint64_t seed, double contrast = 1);
  /// Its left upper corner at that pixel. What lies nearer stays before it.
  void paste(RgbdImage& image, int left, int top) const;

 private:
  double depth_;
  cv::Mat texture_;
};

}  // namespace stdc::test
