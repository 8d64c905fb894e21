#include "slam/image_check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace stdc {

void check_image(const RgbdImage& image, const Camera& camera, int frame) {
  const std::string where = fmt::format("frame {}", frame);
  if (!std::isfinite(image.timestamp)) {
    throw Error(where, "its time is no number", "give the time of the colour image in seconds");
  }
  const cv::Size size(camera.width, camera.height);
  if (image.colour.type() != CV_8UC1 && image.colour.type() != CV_8UC3) {
    throw Error(where, "the colour image is neither 8-bit grey nor 8-bit BGR", "convert it");
  }
  if (!image.grey.empty() && (image.grey.type() != CV_8UC1 || image.colour.channels() == 1)) {
    throw Error(where, "the grey image is not 8-bit grey beside a colour one", "leave it out, or convert it");
  }
  if (!image.depth.empty() && image.depth.type() != CV_16UC1 && image.depth.type() != CV_32FC1) {
    throw Error(where, "the depth image is neither 16-bit nor float", "convert it");
  }
  if (image.colour.size() != size || (!image.depth.empty() && image.depth.size() != size) ||
      (!image.grey.empty() && image.grey.size() != size)) {
    throw Error(where, fmt::format("the images are not {} x {} as the camera is", size.width, size.height),
                "give the right camera, or scale image and calibration together");
  }
}

}  // namespace stdc
