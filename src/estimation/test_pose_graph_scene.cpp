#include "estimation/test_pose_graph_scene.hpp"

#include <algorithm>

namespace stdc::test {

double Loop::max_error() const {
  double max_error = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const Pose error = graph.node_from_world[k] * truth[k].inverse();
    max_error = std::max({max_error, error.translation.norm(), rotation_log(error.rotation).norm()});
  }
  return max_error;
}

Matrix6d information(double metres, double radians) {
  Vector6d diagonal;
  diagonal << Eigen::Vector3d::Constant(1 / (metres * metres)),
      Eigen::Vector3d::Constant(1 / (radians * radians));
  return diagonal.asDiagonal();
}

Loop make_loop(int nodes, int reach, double noise, std::uint64_t seed) {
  Loop loop;
  Random random(seed);
  Pose drift;
  for (int k = 0; k < nodes; ++k) {
    loop.truth.push_back(camera_on_path(kRound * k / nodes));
    loop.graph.node_from_world.push_back(k == 0 ? loop.truth[0] : loop.truth.back() * drift);
    if (k + 1 < nodes) drift = disturbed(drift, random, 0.3 / nodes, 0.3 / nodes);
    loop.graph.fixed.push_back(k == 0 ? 1 : 0);
  }
  const auto measured = [&](int a, int b) {
    return disturbed(loop.truth[a] * loop.truth[b].inverse(), random, noise, noise);
  };
  for (int a = 0; a < nodes; ++a) {
    for (int b = std::max(0, a - reach); b < a; ++b) {
      loop.graph.edges.push_back({a, b, measured(a, b), information(0.01, 0.005)});
    }
  }
  loop.graph.edges.push_back({nodes - 1, 0, measured(nodes - 1, 0), information(0.01, 0.005)});
  return loop;
}

}  // namespace stdc::test
