#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/random.hpp"
#include "estimation/kernels/test_kernel_observations.hpp"
#include "estimation/packed_bundle.hpp"
#include "estimation/schur_step.hpp"

namespace stdc::kernels {
namespace {

constexpr int kFixed = 2;
constexpr Intrinsics kCamera{kFx, kFy, kCx, kCy};
const NoiseSettings kNoise{.pixel_sigma = 1.3, .inverse_depth_sigma = 0.01};

/// A small problem: every point is seen by a random choice of the cameras, by the first moving one sometimes
/// twice, and one point by nobody.
BundleProblem make_bundle(int poses, int points) {
  BundleProblem bundle;
  Random random(5);
  for (int k = 0; k < poses; ++k) {
    const double x = 0.3 * k, angle = 0.1 * k;
    bundle.cam_from_world.push_back(Pose::exp((Vector6d() << x, 0.1, -0.2, 0.05, angle, 0.02).finished()));
    bundle.pose_fixed.push_back(k < kFixed ? 1 : 0);
  }
  for (int p = 0; p < points; ++p) {
    const Eigen::Vector3d local(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(2.0, 4.0));
    bundle.points.push_back(bundle.cam_from_world[static_cast<std::size_t>(poses / 2)].inverse() * local);
    for (int k = 0; k < poses; ++k) {
      const int times = random.uniform() < 0.6 ? (k == kFixed && p % 5 == 0 ? 2 : 1) : 0;
      for (int t = 0; t < times && p != 3; ++t) {
        const Eigen::Vector3d c = bundle.cam_from_world[static_cast<std::size_t>(k)] * bundle.points.back();
        const double nu = random.normal(), nv = random.normal();
        const Eigen::Vector2d pixel(kFx * c.x() / c.z() + kCx + 0.7 * nu,
                                    kFy * c.y() / c.z() + kCy + 0.7 * nv);
        const double depth = p % 3 == 0 ? 0.0 : 1.0 / (1.0 / c.z() + 0.003);
        bundle.observations.push_back(
            {k, p, pixel.cast<float>(), static_cast<float>(depth), t == 0 ? 1.0F : 1.5F});
      }
    }
  }
  return bundle;
}

AlignedObservation observation_of(const BundleProblem& bundle, const BundleObservation& o) {
  const bool has_depth = o.depth > 0;
  return {bundle.points[static_cast<std::size_t>(o.point)], o.pixel.cast<double>(),
          1.0 / (kNoise.pixel_sigma * o.scale), has_depth ? 1.0 / o.depth : 0.0,
          has_depth ? 1.0 / kNoise.inverse_depth_sigma : 0.0};
}

/// A bundle in the kernels' layout, linearised.
struct Linearised {
  PackedBundle packed;
  std::vector<BundleView> views;
  std::vector<BundlePoint> points;
  std::vector<BundleTerm> terms;
  double cost;

  Linearised(const Table& table, const BundleProblem& bundle) : packed(*pack_bundle(bundle, kNoise)) {
    for (const Pose& pose : bundle.cam_from_world) {
      BundleView view;
      const Eigen::Matrix3d r = pose.rotation_matrix();
      for (int k = 0; k < 3; ++k) {
        for (int c = 0; c < 3; ++c) view.rows[k][c] = r(k, c);
        view.rows[k][3] = pose.centre()[k];
      }
      views.push_back(view);
    }
    for (const Eigen::Vector3d& p : bundle.points) points.push_back({{p.x(), p.y(), p.z(), 0}});
    terms.resize(packed.packets.size());
    cost = table.linearise_bundle(packed.packets.data(), packed.packets.size(), views.data(), points.data(),
                                  kCamera, terms.data());
  }
};

TEST(BundleKernel, TermsAgreeWithDifferences) {
  const BundleProblem bundle = make_bundle(5, 20);
  const Linearised linearised(best(), bundle);
  double expected_cost = 0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < linearised.packed.origin.size(); ++i) {
    if (linearised.packed.origin[i] == PackedBundle::kNone) continue;
    ++seen;
    const BundleObservation& o = bundle.observations[linearised.packed.origin[i]];
    const AlignedObservation s = observation_of(bundle, o);
    const Pose& pose = bundle.cam_from_world[static_cast<std::size_t>(o.pose)];
    expected_cost += cost_of(s, pose, s.point);
    const Eigen::RowVectorXd gradient = differentiate(3, [&](const Eigen::VectorXd& delta) {
      return Eigen::VectorXd::Constant(1, cost_of(s, pose, s.point + delta));
    });
    const Eigen::MatrixXd j = differentiate(3, [&](const Eigen::VectorXd& delta) {
      return Eigen::VectorXd(residual_of(s, pose, s.point + delta));
    });
    const Eigen::Matrix3d hessian = j.transpose() * j;
    const BundleTerm& term = linearised.terms[i / kLanes];
    const bool is_square = residual_of(s, pose, s.point).norm() < 1.9;
    for (int r = 0, k = 0; r < 3; ++r) {
      EXPECT_NEAR(term.gradient[r][i % kLanes], gradient[r], 1e-3 * (1 + gradient.norm())) << i;
      EXPECT_NEAR(term.offset[r][i % kLanes], (s.point - pose.centre())[r], 1e-12);
      for (int c = r; c < 3; ++c, ++k) {
        if (!is_square) continue;
        EXPECT_NEAR(term.hessian[k][i % kLanes], hessian(r, c), 1e-5 * hessian.norm()) << i;
      }
    }
  }
  EXPECT_EQ(seen, bundle.observations.size());
  EXPECT_NEAR(linearised.cost, expected_cost, 1e-5 * expected_cost);
}

/// The damped step by the full system, made from differences of the residuals.
Eigen::VectorXd brute_force_step(const BundleProblem& bundle, double damping, double* expected) {
  const auto slots = static_cast<int>(bundle.cam_from_world.size()) - kFixed;
  const auto points = static_cast<int>(bundle.points.size());
  const int size = 6 * slots + 3 * points;
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(size);
  for (const BundleObservation& o : bundle.observations) {
    const AlignedObservation s = observation_of(bundle, o);
    const Pose& pose = bundle.cam_from_world[static_cast<std::size_t>(o.pose)];
    // The camera's parameters: its centre goes by -rho, then it turns by phi, both in world axes.
    const Eigen::MatrixXd j = differentiate(9, [&](const Eigen::VectorXd& d) {
      const Eigen::Quaterniond q = pose.rotation * rotation_exp(d.segment<3>(3));
      return Eigen::VectorXd(
          residual_of(s, Pose(q, -(q * (pose.centre() - d.head<3>()))), s.point + d.tail<3>()));
    });
    const Eigen::Vector3d r = residual_of(s, pose, s.point);
    const double depth_weight = std::min(1.0, std::sqrt(kChiSquare95Depth) / std::abs(r[2]));
    const double pixel_weight = std::min(1.0, std::sqrt(kChiSquare95Pixel) / r.head<2>().norm());
    const Eigen::Vector3d weight(pixel_weight, pixel_weight, depth_weight);
    Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(3, size);
    if (o.pose >= kFixed) wide.middleCols<6>(6 * (o.pose - kFixed)) = j.leftCols<6>();
    wide.middleCols<3>(6 * slots + 3 * o.point) = j.rightCols<3>();
    h += wide.transpose() * weight.asDiagonal() * wide;
    g += wide.transpose() * weight.asDiagonal() * r;
  }
  Eigen::VectorXd added = damping * h.diagonal();
  for (int p = 0; p < points; ++p) {
    const double trace = h.diagonal().segment<3>(6 * slots + 3 * p).sum();
    added.segment<3>(6 * slots + 3 * p).array() += 1e-3 * damping * trace;
    if (trace == 0) h.diagonal().segment<3>(6 * slots + 3 * p).setOnes();
  }
  h.diagonal() += added;
  const Eigen::VectorXd step = -h.ldlt().solve(g);
  *expected = 0.5 * step.dot(added.cwiseProduct(step) - g);
  return step;
}

/// The same by elimination of the points.
Eigen::VectorXd eliminated_step(const Table& table, const BundleProblem& bundle, double damping,
                                double* expected) {
  const Linearised linearised(table, bundle);
  SchurStep step(table, linearised.packed);
  std::vector<BundlePoint> moved(bundle.points.size());
  EXPECT_TRUE(step.solve(linearised.terms, linearised.points, damping, &moved));
  *expected = step.expected_decrease();
  const std::size_t slots = linearised.packed.slot_pose.size();
  Eigen::VectorXd result(6 * slots + 3 * moved.size());
  for (std::size_t s = 0; s < slots; ++s) {
    const auto row = 6 * (linearised.packed.slot_pose[s] - kFixed);
    result.segment<6>(row) = Eigen::Map<const Vector6d>(step.camera_step(s));
  }
  for (std::size_t p = 0; p < moved.size(); ++p) {
    const auto row = static_cast<Eigen::Index>(6 * slots + 3 * p);
    const auto *to = moved[p].position, *from = linearised.points[p].position;
    result.segment<3>(row) = Eigen::Map<const Eigen::Vector3d>(to) - Eigen::Map<const Eigen::Vector3d>(from);
  }
  return result;
}

TEST(BundleKernel, EliminationGivesTheStepOfTheFullSystem) {
  for (const int poses : {3, 7}) {
    const BundleProblem bundle = make_bundle(poses, 60);
    for (const double damping : {1e-4, 1e-1}) {
      double expected = 0, brute_force_expected = 0;
      const Eigen::VectorXd step = eliminated_step(best(), bundle, damping, &expected);
      const Eigen::VectorXd brute_force = brute_force_step(bundle, damping, &brute_force_expected);
      EXPECT_LT((step - brute_force).norm(), 1e-4 * brute_force.norm());
      EXPECT_NEAR(expected, brute_force_expected, 1e-4 * brute_force_expected);
    }
  }
}

TEST(BundleKernel, AllInstructionSetsGiveTheSameBytes) {
  const BundleProblem bundle = make_bundle(6, 50);
  double expected_a = 0, expected_b = 0;
  const Eigen::VectorXd x = eliminated_step(best(), bundle, 1e-3, &expected_a);
  const Eigen::VectorXd y = eliminated_step(baseline(), bundle, 1e-3, &expected_b);
  EXPECT_TRUE(x == y);
  EXPECT_EQ(expected_a, expected_b);
  Linearised p(best(), bundle), q(baseline(), bundle);
  EXPECT_EQ(p.cost, q.cost);
  const std::size_t count = p.packed.packets.size();
  const double cost = best().classify_bundle(p.packed.packets.data(), count, p.views.data(), p.points.data(),
                                             kCamera, {5.0, 3.0});
  EXPECT_EQ(cost, baseline().classify_bundle(q.packed.packets.data(), count, q.views.data(), q.points.data(),
                                             kCamera, {5.0, 3.0}));
  EXPECT_EQ(std::memcmp(p.packed.packets.data(), q.packed.packets.data(), count * sizeof(BundlePacket)), 0);
}

}  // namespace
}  // namespace stdc::kernels
