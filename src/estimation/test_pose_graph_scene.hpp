#pragma once

#include <cmath>
#include <vector>

#include "estimation/pose_graph.hpp"
#include "estimation/test_synthetic_scene.hpp"

/// Pose graphs with known answers, for the tests.
namespace stdc::test {

inline constexpr double kRound = 2 * M_PI * 1.2;  ///< length of camera_on_path's round [m]

struct Loop {
  PoseGraph graph;
  std::vector<Pose> truth;

  double max_error() const;
};

Matrix6d information(double metres, double radians);

/// A round of the camera: nodes drift, edges to the `reach` nodes before, and one that closes the loop.
/// @param noise  of the edges [m], [rad]; 0: they are true
Loop make_loop(int nodes, int reach, double noise, std::uint64_t seed = 1);

}  // namespace stdc::test
