#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "input/layouts/scannet/scannet_cameras.hpp"

namespace stdc {

/// How the images of a .sens file are stored.
enum class SensColour { raw = 0, png = 1, jpeg = 2 };
enum class SensDepth { raw = 0, zlib = 1 };

/// A frame of a .sens file: where its images are.
struct SensFrame {
  std::optional<Pose> world_from_cam;  ///< nothing where the scan was lost
  std::uint64_t colour_time = 0, depth_time = 0;
  std::uint64_t colour_at = 0, colour_bytes = 0, depth_at = 0, depth_bytes = 0;  ///< [bytes] from the start
};

/// What a .sens file of ScanNet (Dai et al., CVPR 2017) says, without its images.
struct SensIndex {
  ScanNetCalibration calibration;
  SensColour colour = SensColour::jpeg;
  SensDepth depth = SensDepth::zlib;
  std::vector<SensFrame> frames;
  std::uint64_t stated_frames = 0;  ///< by the head; more than `frames` if the file ends too early
};

/// Reads the head and passes over the images. Throws Error for what is no .sens file of version 4, unknown
/// compressions and impossible sizes. A file that ends too early is read as far as its frames are whole.
SensIndex read_sens_index(std::istream& file, const std::string& name);

}  // namespace stdc
