#pragma once

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include <string>

#include "core/files/test_folder.hpp"
#include "core/images/image_codec.hpp"
#include "core/random.hpp"
#include "input/camera_file.hpp"

namespace stdc::test {

inline Camera test_camera() {
  Camera camera;
  camera.width = 320, camera.height = 240;
  camera.fx = camera.fy = 300, camera.cx = 159.5, camera.cy = 119.5;
  return camera;
}

/// Blots of many sizes: corners on every pyramid level.
inline cv::Mat test_texture(int side) {
  Random random(5);
  cv::Mat texture(side, side, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < side * side / 150; ++i) {
    const cv::Point corner(static_cast<int>(random.below(static_cast<std::uint32_t>(side))),
                           static_cast<int>(random.below(static_cast<std::uint32_t>(side))));
    const cv::Size size(3 + static_cast<int>(random.below(14)), 3 + static_cast<int>(random.below(14)));
    cv::rectangle(texture, {corner, size}, cv::Scalar(random.below(256)), cv::FILLED);
  }
  return texture;
}

/// Writes a sequence to folder/name: a camera that moves sideways by 1 cm a frame before a textured wall at 2
/// m. With camera.yaml and ground truth.
inline void write_test_sequence(const TestFolder& folder, const std::string& name, int frames) {
  const Camera camera = test_camera();
  constexpr double kDistance = 2, kStep = 0.01;  // [m]
  const cv::Mat texture = test_texture(600);
  std::string rgb = "# colour\n", depth = "# depth\n", truth = "# truth\n";
  const cv::Mat range(camera.height, camera.width, CV_16UC1,
                      cv::Scalar(kDistance * camera.depth_units_per_metre));
  for (int i = 0; i < frames; ++i) {
    const double time = 100 + i / 30.0;
    const double shift = camera.fx * kStep * i / kDistance;
    const cv::Matx23d image_to_texture(1, 0, 40 + shift, 0, 1, 40);
    cv::Mat grey, colour;
    cv::warpAffine(texture, grey, image_to_texture, {camera.width, camera.height},
                   cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
    folder.write(fmt::format("{}/rgb/{}.png", name, i), encode_png(colour, PngEffort::fast));
    folder.write(fmt::format("{}/depth/{}.png", name, i), encode_png(range, PngEffort::fast));
    rgb += fmt::format("{:.6f} rgb/{}.png\n", time, i);
    depth += fmt::format("{:.6f} depth/{}.png\n", time + 0.003, i);
    truth += fmt::format("{:.6f} {:.6f} 0 0 0 0 0 1\n", time, kStep * i);
  }
  folder.write(name + "/rgb.txt", rgb);
  folder.write(name + "/depth.txt", depth);
  folder.write(name + "/groundtruth.txt", truth);
  folder.write(name + "/camera.yaml", format_camera(camera));
}

}  // namespace stdc::test
