#include <gtest/gtest.h>

#include <cstring>

#include "estimation/kernel_test_sights.hpp"

namespace stdc::kernels {
namespace {

std::vector<PoseFour> pack(const std::vector<Sight>& sights) {
  std::vector<PoseFour> fours((sights.size() + kLanes - 1) / kLanes);
  for (std::size_t i = 0; i < sights.size(); ++i) {
    PoseFour& four = fours[i / kLanes];
    const std::size_t l = i % kLanes;
    const Sight& s = sights[i];
    four.x[l] = s.point.x(), four.y[l] = s.point.y(), four.z[l] = s.point.z();
    four.u[l] = s.pixel.x(), four.v[l] = s.pixel.y();
    four.inverse_sigma[l] = s.inverse_sigma, four.inverse_depth[l] = s.inverse_depth;
    four.depth_weight[l] = s.depth_weight;
    four.use_pixel[l] = 1, four.use_depth[l] = s.depth_weight > 0 ? 1 : 0;
  }
  return fours;
}

PinholeView view_of(const Pose& pose) {
  PinholeView view{{}, {}, kFx, kFy, kCx, kCy};
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(view.rotation) = pose.rotation_matrix();
  Eigen::Map<Eigen::Vector3d>(view.translation) = pose.translation;
  return view;
}

const Pose kPose = Pose::exp((Vector6d() << 0.3, -0.2, 0.5, 0.4, -0.7, 0.2).finished());

TEST(PoseKernel, PoseCostAndGradientAgreeWithDifferences) {
  const std::vector<Sight> sights = make_sights(kPose, 90, 1.0, true);
  std::vector<PoseFour> fours = pack(sights);
  PoseSystem system;
  best().linearise_pose(fours.data(), fours.size(), view_of(kPose), nullptr, &system);
  const auto total = [&](const Eigen::VectorXd& twist) {
    double sum = 0;
    for (const Sight& s : sights) sum += cost_of(s, Pose::exp(twist) * kPose, s.point);
    return Eigen::VectorXd::Constant(1, sum);
  };
  EXPECT_NEAR(system.cost, total(Vector6d::Zero())[0], 1e-9 * system.cost);
  const Eigen::RowVectorXd gradient = differentiate(6, total);
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(system.g[k], gradient[k], 1e-5 * gradient.norm()) << k;
}

TEST(PoseKernel, PoseHessianIsTheSquareOfTheJacobian) {
  const std::vector<Sight> sights = make_sights(kPose, 43, 0.1, false);
  std::vector<PoseFour> fours = pack(sights);
  PoseSystem system;
  best().linearise_pose(fours.data(), fours.size(), view_of(kPose), nullptr, &system);
  Matrix6d expected = Matrix6d::Zero();
  for (const Sight& s : sights) {
    const Eigen::MatrixXd j = differentiate(6, [&](const Eigen::VectorXd& twist) {
      return Eigen::VectorXd(residual_of(s, Pose::exp(twist) * kPose, s.point));
    });
    expected += j.transpose() * j;
  }
  for (int i = 0, k = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j, ++k) EXPECT_NEAR(system.h[k], expected(i, j), 1e-6 * expected.norm());
  }
}

TEST(PoseKernel, AllInstructionSetsGiveTheSameBytes) {
  std::vector<PoseFour> fours = pack(make_sights(kPose, 101, 1.0, true)), again = fours;
  PoseSystem a, b;
  const Gate gate{5.0, 3.0};
  for (const Gate* choice : {static_cast<const Gate*>(nullptr), &gate}) {
    best().linearise_pose(fours.data(), fours.size(), view_of(kPose), choice, &a);
    baseline().linearise_pose(again.data(), again.size(), view_of(kPose), choice, &b);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
    EXPECT_EQ(std::memcmp(fours.data(), again.data(), fours.size() * sizeof(PoseFour)), 0);
  }
}
}  // namespace
}  // namespace stdc::kernels
