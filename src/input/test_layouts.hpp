#pragma once

#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <string>

#include "core/files/test_folder.hpp"
#include "core/images/image_codec.hpp"
#include "input/camera_file.hpp"

namespace stdc::test {

inline Camera layout_camera() {
  Camera camera;
  camera.width = 80, camera.height = 64, camera.cx = 40, camera.cy = 32;
  return camera;
}

/// The colour and depth of frame `i` of a made-up recording: of one value each.
inline cv::Mat layout_colour(int i) {
  const Camera camera = layout_camera();
  return {camera.height, camera.width, CV_8UC3, cv::Scalar(i, 2 * i, 50)};
}
inline cv::Mat layout_depth(int units) {
  const Camera camera = layout_camera();
  return {camera.height, camera.width, CV_16UC1, cv::Scalar(units)};
}

/// A folder in TUM layout at 30 Hz, depth 5 ms after colour, 5000 + i units.
inline void write_tum_folder(const TestFolder& folder, const std::string& name, int frames) {
  std::string rgb, depth;
  for (int i = 0; i < frames; ++i) {
    folder.write(fmt::format("{}/rgb/{}.png", name, i), encode_png(layout_colour(i)));
    folder.write(fmt::format("{}/depth/{}.png", name, i), encode_png(layout_depth(5000 + i)));
    rgb += fmt::format("{:.6f} rgb/{}.png\n", 100 + i / 30.0, i);
    depth += fmt::format("{:.6f} depth/{}.png\n", 100.005 + i / 30.0, i);
  }
  folder.write(name + "/rgb.txt", rgb);
  folder.write(name + "/depth.txt", depth);
  folder.write(name + "/camera.yaml", format_camera(layout_camera()));
}

}  // namespace stdc::test
