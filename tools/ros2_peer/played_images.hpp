#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera.hpp"

namespace stdc::ros2_peer {

/// The images of a sequence, decoded: playing must not wait for that.
struct PlayedImages {
  struct Frame {
    std::int64_t colour_stamp = 0, depth_stamp = 0;  ///< [ns]
    cv::Mat colour;                                  ///< CV_8UC3, red first, or CV_8UC1
    cv::Mat depth;                                   ///< CV_16UC1, in units of the camera
  };
  Camera camera;
  std::vector<Frame> frames;
};

/// Reads a sequence in TUM layout.
/// @param max_frames  0: all
/// @param size        images of another size are resized to it; empty: as they are
PlayedImages read_images(const std::filesystem::path& folder, int max_frames, cv::Size size);

}  // namespace stdc::ros2_peer
