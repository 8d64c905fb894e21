#pragma once

#include <vector>

#include "simulation/sequence/rendered_sequence.hpp"
#include "slam/slam.hpp"

namespace stdc::test {

/// Small frames, rendered once for all tests.
struct Footage {
  Camera camera;
  std::vector<simulation::RenderedFrame> frames;

  /// A hundred frames, 1/30 s apart.
  static const Footage& of_a_desk();
  /// A walk through a quarter of a room: 120 frames, 1/15 s apart.
  static const Footage& of_a_room();

 private:
  Footage(simulation::Preset preset, int first, int step, int count);
};

bool same_bytes(const std::vector<FramePose>& a, const std::vector<FramePose>& b);

}  // namespace stdc::test
