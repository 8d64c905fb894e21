#pragma once

#include <vector>

#include "simulation/sequence/rendered_sequence.hpp"
#include "slam/slam.hpp"

namespace stdc::test {

/// A sequence of small frames, rendered once for all tests.
struct TestSequence {
  Camera camera;
  std::vector<simulation::RenderedFrame> frames;

  /// A hundred frames, 1/30 s apart.
  static const TestSequence& of_a_desk();
  /// A walk through a quarter of a room: 120 frames, 1/15 s apart.
  static const TestSequence& of_a_room();

 private:
  TestSequence(simulation::Preset preset, int first, int step, int count);
};

bool same_bytes(const std::vector<FramePose>& a, const std::vector<FramePose>& b);

}  // namespace stdc::test
