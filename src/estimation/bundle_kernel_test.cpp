#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cstring>

#include "estimation/block_pattern.hpp"
#include "estimation/kernel_test_sights.hpp"

namespace stdc::kernels {
namespace {

/// A small bundle: every point is seen by a random choice of the cameras, by the first one sometimes twice.
struct Bundle {
  std::vector<Pose> poses;
  std::vector<Eigen::Vector3d> points;
  std::vector<Sight> sights;
  std::vector<int> pose_of, point_of;
  std::vector<std::int32_t> slot;
  std::vector<std::uint32_t> point_start{0};
  int fixed = 2;
};

Bundle make_bundle(int poses, int points) {
  Bundle bundle;
  Random random(5);
  for (int k = 0; k < poses; ++k) {
    const double x = 0.3 * k, turn = 0.1 * k;
    bundle.poses.push_back(Pose::exp((Vector6d() << x, 0.1, -0.2, 0.05, turn, 0.02).finished()));
  }
  for (int p = 0; p < points; ++p) {
    const Eigen::Vector3d local(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(2.0, 4.0));
    bundle.points.push_back(bundle.poses[static_cast<std::size_t>(poses / 2)].inverse() * local);
    for (int k = 0; k < poses; ++k) {
      const int times = random.uniform() < 0.6 ? (k == bundle.fixed && p % 5 == 0 ? 2 : 1) : 0;
      for (int t = 0; t < times; ++t) {
        const Eigen::Vector3d c = bundle.poses[static_cast<std::size_t>(k)] * bundle.points.back();
        const double nu = random.normal(), nv = random.normal();
        bundle.sights.push_back({bundle.points.back(),
                                 {kFx * c.x() / c.z() + kCx + 0.5 * nu, kFy * c.y() / c.z() + kCy + 0.5 * nv},
                                 0.7,
                                 1.0 / c.z() + 0.003,
                                 p % 3 == 0 ? 0.0 : 100.0});
        bundle.pose_of.push_back(k), bundle.point_of.push_back(p);
        bundle.slot.push_back(k < bundle.fixed ? -1 : k - bundle.fixed);
      }
    }
    bundle.point_start.push_back(static_cast<std::uint32_t>(bundle.sights.size()));
  }
  return bundle;
}

/// A bundle in the kernels' layout.
struct Packed {
  std::vector<BundleFour> fours;
  std::vector<BundleView> views;
  std::vector<BundlePoint> points;
  std::vector<BundleTerm> terms;

  explicit Packed(const Bundle& bundle) : fours((bundle.sights.size() + 3) / 4), terms(fours.size()) {
    for (std::size_t i = 0; i < bundle.sights.size(); ++i) {
      const Sight& s = bundle.sights[i];
      BundleFour& four = fours[i / 4];
      const std::size_t l = i % 4;
      four.u[l] = static_cast<float>(s.pixel.x()), four.v[l] = static_cast<float>(s.pixel.y());
      four.inverse_depth[l] = static_cast<float>(s.inverse_depth);
      four.inverse_sigma[l] = four.used_inverse_sigma[l] = static_cast<float>(s.inverse_sigma);
      four.depth_weight[l] = four.used_depth_weight[l] = static_cast<float>(s.depth_weight);
      four.pose[l] = bundle.pose_of[i], four.point[l] = bundle.point_of[i];
    }
    for (const Pose& pose : bundle.poses) {
      BundleView view;
      const Eigen::Matrix3d r = pose.rotation_matrix();
      for (int k = 0; k < 3; ++k) {
        for (int c = 0; c < 3; ++c) view.rows[k][c] = r(k, c);
        view.rows[k][3] = pose.centre()[k];
      }
      views.push_back(view);
    }
    for (const Eigen::Vector3d& p : bundle.points) points.push_back({{p.x(), p.y(), p.z(), 0}});
  }
};

TEST(BundleKernel, BundleTermsAgreeWithDifferences) {
  const Bundle bundle = make_bundle(5, 20);
  Packed packed(bundle);
  const double cost =
      best().linearise_bundle(packed.fours.data(), packed.fours.size(), packed.views.data(),
                              packed.points.data(), {kFx, kFy, kCx, kCy}, packed.terms.data());
  double expected_cost = 0;
  for (std::size_t i = 0; i < bundle.sights.size(); ++i) {
    const Sight& s = bundle.sights[i];
    const Pose& pose = bundle.poses[static_cast<std::size_t>(bundle.pose_of[i])];
    expected_cost += cost_of(s, pose, s.point);
    const Eigen::RowVectorXd gradient = differentiate(3, [&](const Eigen::VectorXd& delta) {
      return Eigen::VectorXd::Constant(1, cost_of(s, pose, s.point + delta));
    });
    const Eigen::MatrixXd j = differentiate(3, [&](const Eigen::VectorXd& delta) {
      return Eigen::VectorXd(residual_of(s, pose, s.point + delta));
    });
    const Eigen::Matrix3d hessian = j.transpose() * j;
    const BundleTerm& term = packed.terms[i / 4];
    const bool is_square = residual_of(s, pose, s.point).norm() < 1.9;
    for (int r = 0, k = 0; r < 3; ++r) {
      EXPECT_NEAR(term.gradient[r][i % 4], gradient[r], 1e-3 * (1 + gradient.norm())) << i;
      for (int c = r; c < 3; ++c, ++k) {
        if (!is_square) continue;
        EXPECT_NEAR(term.hessian[k][i % 4], hessian(r, c), 1e-5 * hessian.norm()) << i;
      }
    }
  }
  EXPECT_NEAR(cost, expected_cost, 1e-5 * expected_cost);
}

/// The damped step by the full system, made from differences of the residuals.
Eigen::VectorXd brute_force_step(const Bundle& bundle, double damping, double* expected) {
  const auto slots = static_cast<int>(bundle.poses.size()) - bundle.fixed;
  const auto points = static_cast<int>(bundle.points.size());
  const int size = 6 * slots + 3 * points;
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(size);
  for (std::size_t i = 0; i < bundle.sights.size(); ++i) {
    const Sight& s = bundle.sights[i];
    const Pose& pose = bundle.poses[static_cast<std::size_t>(bundle.pose_of[i])];
    // The camera's parameters: its centre goes by -rho, then it turns by phi, both in world axes.
    const auto moved = [&](const Eigen::VectorXd& d) {
      const Eigen::Quaterniond q = pose.rotation * rotation_exp(d.segment<3>(3));
      return Eigen::VectorXd(
          residual_of(s, Pose(q, -(q * (pose.centre() - d.head<3>()))), s.point + d.tail<3>()));
    };
    const Eigen::MatrixXd j = differentiate(9, moved);
    const Eigen::Vector3d r = residual_of(s, pose, s.point);
    const double depth_weight = std::min(1.0, std::sqrt(kChiSquare95Depth) / std::abs(r[2]));
    const double pixel_weight = std::min(1.0, std::sqrt(kChiSquare95Pixel) / r.head<2>().norm());
    const Eigen::Vector3d weight(pixel_weight, pixel_weight, depth_weight);
    Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(3, size);
    if (bundle.slot[i] >= 0) wide.middleCols<6>(6 * bundle.slot[i]) = j.leftCols<6>();
    wide.middleCols<3>(6 * slots + 3 * bundle.point_of[i]) = j.rightCols<3>();
    h += wide.transpose() * weight.asDiagonal() * wide;
    g += wide.transpose() * weight.asDiagonal() * r;
  }
  Eigen::VectorXd added = damping * h.diagonal();
  for (int p = 0; p < points; ++p) {
    const double trace = h.diagonal().segment<3>(6 * slots + 3 * p).sum();
    added.segment<3>(6 * slots + 3 * p).array() += 1e-3 * damping * trace;
  }
  h.diagonal() += added;
  const Eigen::VectorXd step = -h.ldlt().solve(g);
  *expected = step.dot(added.cwiseProduct(step) - g);
  return step;
}

struct alignas(64) Column {
  double value[kSegment];
};

/// The same by elimination of the points; all cameras see points in common, so the pattern is full.
Eigen::VectorXd eliminated_step(const Table& kernels, const Bundle& bundle, double damping,
                                double* expected) {
  Packed packed(bundle);
  kernels.linearise_bundle(packed.fours.data(), packed.fours.size(), packed.views.data(),
                           packed.points.data(), {kFx, kFy, kCx, kCy}, packed.terms.data());
  const std::size_t slots = bundle.poses.size() - static_cast<std::size_t>(bundle.fixed);
  BlockPattern pattern(slots);
  for (std::size_t a = 0; a < slots; ++a) {
    for (std::size_t b = 0; b < a; ++b) pattern.connect(a, b);
  }
  pattern.eliminate();
  std::vector<std::uint32_t> pairs;
  std::size_t most = 0;
  for (std::size_t p = 0; p < bundle.points.size(); ++p) {
    std::vector<std::size_t> moving;
    for (std::uint32_t o = bundle.point_start[p]; o < bundle.point_start[p + 1]; ++o) {
      if (bundle.slot[o] >= 0) moving.push_back(static_cast<std::size_t>(bundle.slot[o]));
    }
    most = std::max(most, moving.size());
    for (std::size_t i = 0; i < moving.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) pairs.push_back(pattern.block(moving[i], moving[j]));
    }
  }
  std::vector<Column> blocks(6 * pattern.blocks()), gradient(slots), step(slots), diagonal(slots),
      scratch(3 * most);
  const auto numbers = [](std::vector<Column>& list) { return reinterpret_cast<double*>(list.data()); };
  std::vector<PointSystem> systems(bundle.points.size());
  const SchurInput in{packed.fours.data(),
                      packed.terms.data(),
                      packed.views.data(),
                      packed.points.data(),
                      bundle.point_start.data(),
                      bundle.points.size(),
                      bundle.slot.data(),
                      pattern.starts().data(),
                      pairs.data(),
                      damping};
  kernels.eliminate_points(in, {systems.data(), numbers(blocks), numbers(gradient), numbers(step),
                                numbers(diagonal), numbers(scratch)});
  *expected = 0;
  for (std::size_t s = 0; s < slots; ++s) {
    for (std::size_t k = 0; k < 6; ++k) {
      diagonal[s].value[k] *= damping;
      blocks[6 * pattern.starts()[s] + k].value[k] += diagonal[s].value[k];
      step[s].value[k] = -(gradient[s].value[k] + step[s].value[k]);
    }
  }
  const BlockColumns columns{slots, pattern.starts().data(), pattern.rows().data()};
  EXPECT_TRUE(kernels.factorise(columns, numbers(blocks)));
  kernels.solve(columns, numbers(blocks), numbers(step));
  std::vector<BundlePoint> moved(bundle.points.size());
  *expected = kernels.substitute_points(in, systems.data(), numbers(step), moved.data());
  Eigen::VectorXd result(6 * slots + 3 * bundle.points.size());
  for (std::size_t s = 0; s < slots; ++s) {
    for (std::size_t k = 0; k < 6; ++k) {
      const double x = step[s].value[k];
      result[static_cast<Eigen::Index>(6 * s + k)] = x;
      *expected += x * (diagonal[s].value[k] * x - gradient[s].value[k]);
    }
  }
  for (std::size_t p = 0; p < moved.size(); ++p) {
    for (std::size_t k = 0; k < 3; ++k) {
      result[static_cast<Eigen::Index>(6 * slots + 3 * p + k)] =
          moved[p].position[k] - packed.points[p].position[k];
    }
  }
  return result;
}

TEST(BundleKernel, EliminationGivesTheStepOfTheFullSystem) {
  const Bundle bundle = make_bundle(7, 60);
  for (const double damping : {1e-4, 1e-1}) {
    double expected = 0, brute_force_expected = 0;
    const Eigen::VectorXd step = eliminated_step(best(), bundle, damping, &expected);
    const Eigen::VectorXd brute_force = brute_force_step(bundle, damping, &brute_force_expected);
    EXPECT_LT((step - brute_force).norm(), 1e-4 * brute_force.norm());
    EXPECT_NEAR(expected, brute_force_expected, 1e-4 * brute_force_expected);
  }
}

TEST(BundleKernel, AllInstructionSetsGiveTheSameBytes) {
  const Bundle bundle = make_bundle(6, 50);
  double expected_a = 0, expected_b = 0;
  const Eigen::VectorXd x = eliminated_step(best(), bundle, 1e-3, &expected_a);
  const Eigen::VectorXd y = eliminated_step(baseline(), bundle, 1e-3, &expected_b);
  EXPECT_TRUE(x == y);
  EXPECT_EQ(expected_a, expected_b);
  Packed p(bundle), q(bundle);
  const Intrinsics camera{kFx, kFy, kCx, kCy};
  EXPECT_EQ(
      best().classify_bundle(p.fours.data(), p.fours.size(), p.views.data(), p.points.data(), camera),
      baseline().classify_bundle(q.fours.data(), q.fours.size(), q.views.data(), q.points.data(), camera));
  EXPECT_EQ(std::memcmp(p.fours.data(), q.fours.data(), p.fours.size() * sizeof(BundleFour)), 0);
}

}  // namespace
}  // namespace stdc::kernels
