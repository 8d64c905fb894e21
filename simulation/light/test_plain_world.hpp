#pragma once

#include <opencv2/core/mat.hpp>

#include "simulation/scene/shapes.hpp"
#include "simulation/scene/world.hpp"

namespace stdc::simulation::test {

/// A world with one material, plain grey.
inline World plain_world() {
  World world;
  world.textures.emplace_back(cv::Mat(4, 4, CV_8UC3, cv::Scalar(128, 128, 128)));
  world.materials.emplace_back();
  world.low = {-2, -2, 0};
  world.high = {2, 2, 2};
  return world;
}

}  // namespace stdc::simulation::test
