#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/camera.hpp"
#include "core/pose.hpp"

namespace stdc {

/// metadata.json of Record3D: see is_record3d() for what is taken for granted.
struct Record3dMetadata {
  Camera camera;              ///< of the colour images
  std::vector<double> times;  ///< of the frames [s], strictly increasing; empty if it has none
  std::vector<std::optional<Pose>>
      poses;  ///< of the frames, world from camera, with the usual axes; may be fewer
};

/// Throws Error naming `where` if it is no JSON of this kind.
Record3dMetadata parse_record3d_metadata(const std::string& text, const std::string& where);

}  // namespace stdc
