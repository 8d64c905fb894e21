#pragma once

#include "simulation/sequence/rendered_sequence.hpp"

namespace stdc::simulation {

/// Few pixels, so that tests render many frames.
inline Camera small_camera() {
  Camera camera = default_render_camera();
  camera.width = 96;
  camera.height = 72;
  camera.fx = camera.fy = 80;
  camera.cx = 48;
  camera.cy = 37;
  return camera;
}

}  // namespace stdc::simulation
