#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "input/frame_source.hpp"

namespace stdc {

/// An image as OpenNI gave it: RGB (CV_8UC3), grey (CV_8UC1), or depth (CV_16UC1).
struct OpenNiImage {
  cv::Mat image;                                            ///< looks into the pixels
  std::shared_ptr<const std::vector<std::uint8_t>> pixels;  ///< live as long as a frame uses them
};

/// @param where  names the frame in errors
std::shared_ptr<const PackedImages> pack_openni_images(std::string where, OpenNiImage colour,
                                                       OpenNiImage depth);

}  // namespace stdc
