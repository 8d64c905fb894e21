#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/ids.hpp"
#include "core/pose.hpp"

namespace stdc {

/// What some frames in a row have seen of the static scene, fused into the first of them and compressed: what
/// a dense map is made of. It belongs to a keyframe and so follows the map. Its images are those of the
/// pinhole camera that dense/fusion/rectifier.hpp makes of the map's camera.
struct DenseView {
  KeyframeId reference;
  Pose cam_from_reference;            ///< of its first frame
  int frame = 0;                      ///< index of that
  double timestamp = 0;               ///< [s] of that
  std::vector<std::uint8_t> depth;    ///< PNG, see dense/fusion/view_codec.hpp
  std::vector<std::uint8_t> support;  ///< PNG
  std::vector<std::uint8_t> colour;   ///< JPEG
};

/// Views by time; immutable, so they are shared, not copied.
using DenseViews = std::vector<std::shared_ptr<const DenseView>>;

}  // namespace stdc
