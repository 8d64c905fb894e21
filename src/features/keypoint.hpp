#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace stdc {

/// Which FAST threshold a keypoint passed: T_H (high) or only T_L (low). Paper, Alg. 2.
enum class KeypointQuality : std::uint8_t { low, high };

/// A keypoint in raw pixels of the full-size image.
struct Keypoint {
  float x = 0, y = 0;  ///< [px] of level 0
  float angle = 0;     ///< intensity-centroid orientation, [rad] in (-pi, pi]
  float response = 0;  ///< corner strength; comparable within one selection method only
  std::uint8_t level = 0;
  KeypointQuality quality = KeypointQuality::low;
};

/// 256-bit steered BRIEF descriptor.
struct alignas(32) Descriptor {
  std::array<std::uint64_t, 4> bits{};
  bool operator==(const Descriptor&) const = default;
};

/// The result of extraction: same length, same order (by level, then by y, then by x).
struct Features {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;
};

}  // namespace stdc
