#include <gtest/gtest.h>

#include <cmath>

#include "estimation/test_pose_graph_scene.hpp"

#if defined(STDC_HAVE_CERES)
#include <ceres/ceres.h>

#include "core/random.hpp"

namespace stdc {
namespace {

/// The same error as a function of the two poses' left perturbations, by Ceres' automatic differentiation.
struct EdgeError {
  Pose a, b, b_from_a;
  Matrix6d root;  ///< of the information, upper triangle

  /// log(exp(x) E exp(y)) for small x and y would need a logarithm of dual numbers: the pose is put together
  /// from quaternions instead, as Ceres does it.
  template <typename T>
  static void perturbed(const Pose& pose, const T* x, Eigen::Quaternion<T>& q, Eigen::Matrix<T, 3, 1>& t) {
    const Eigen::Matrix<T, 3, 1> rho(x[0], x[1], x[2]), phi(x[3], x[4], x[5]);
    q = Eigen::Quaternion<T>(T(1), phi.x() / T(2), phi.y() / T(2), phi.z() / T(2)).normalized();
    t = q * pose.translation.cast<T>() + rho;
    q = q * pose.rotation.cast<T>();
  }
  template <typename T>
  bool operator()(const T* x, const T* y, T* residuals) const {
    Eigen::Quaternion<T> qa, qb;
    Eigen::Matrix<T, 3, 1> ta, tb;
    perturbed(a, x, qa, ta);
    perturbed(b, y, qb, tb);
    const Eigen::Quaternion<T> a_from_b = qa * qb.conjugate();
    const Eigen::Matrix<T, 3, 1> t = ta - a_from_b * tb;
    const Eigen::Quaternion<T> q = a_from_b * b_from_a.rotation.cast<T>();
    const Eigen::Matrix<T, 3, 1> moved = t + a_from_b * b_from_a.translation.cast<T>();
    // log of SE(3)
    const T sign = q.w() < T(0) ? T(-1) : T(1);
    const T sine = q.vec().norm();
    const T angle = T(2) * atan2(sine, sign * q.w());
    const Eigen::Matrix<T, 3, 1> phi = q.vec() * (sign * angle / sine);
    const Eigen::Matrix<T, 3, 1> cross = phi.cross(moved);
    const T half = angle / T(2);
    const T c = (T(1) - half * cos(half) / sin(half)) / (angle * angle);
    Eigen::Matrix<T, 6, 1> e;
    e << moved - cross / T(2) + phi.cross(cross) * c, phi;
    Eigen::Map<Eigen::Matrix<T, 6, 1>>{residuals} = root.cast<T>() * e;
    return true;
  }
};

/// Gauss-Newton by Ceres: solves for perturbations about the given poses, again and again.
double solve_by_ceres(PoseGraph& graph, double robust_chi_square) {
  double cost = 0;
  for (int round = 0; round < 15; ++round) {
    std::vector<Vector6d> steps(graph.node_from_world.size(), Vector6d::Zero());
    ceres::Problem problem;
    for (const PoseGraphEdge& e : graph.edges) {
      auto* error = new EdgeError{graph.node_from_world[e.a], graph.node_from_world[e.b],
                                  e.a_from_b.inverse(), e.information.llt().matrixU()};
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<EdgeError, 6, 6, 6>(error),
                               e.robust ? new ceres::HuberLoss(std::sqrt(robust_chi_square)) : nullptr,
                               steps[e.a].data(), steps[e.b].data());
    }
    for (std::size_t k = 0; k < steps.size(); ++k) {
      if (graph.fixed[k] != 0) problem.SetParameterBlockConstant(steps[k].data());
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 20;
    options.function_tolerance = 1e-14;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const Eigen::Vector3d phi = steps[k].tail<3>();
      Pose step(Eigen::Quaterniond(1, phi.x() / 2, phi.y() / 2, phi.z() / 2), steps[k].head<3>());
      graph.node_from_world[k] = step * graph.node_from_world[k];
    }
    cost = summary.final_cost;
  }
  return cost;
}

TEST(PoseGraph, FindsWhatCeresFinds) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    test::Loop ours = test::make_loop(60, 4, 0.02, seed);
    Random random(seed);
    for (PoseGraphEdge& edge : ours.graph.edges) {
      Matrix6d mix;
      for (double& m : mix.reshaped()) m = random.normal();
      edge.information += 300 * mix * mix.transpose();
      edge.robust = random.below(3) == 0;
    }
    test::Loop theirs = ours;
    const PoseGraphSettings settings{.iterations = 100, .min_relative_decrease = 0};
    const PoseGraphResult result = optimise_pose_graph(ours.graph, settings);
    const double reference = solve_by_ceres(theirs.graph, settings.robust_chi_square);
    EXPECT_NEAR(result.final_cost, reference, 1e-6 * reference);
    for (std::size_t k = 0; k < 60; ++k) {
      const Pose difference = ours.graph.node_from_world[k] * theirs.graph.node_from_world[k].inverse();
      EXPECT_LT(difference.log().norm(), 1e-4);
    }
  }
}

}  // namespace
}  // namespace stdc

#endif
