#include <gtest/gtest.h>

#include <cstring>

#include "estimation/kernels/test_kernel_observations.hpp"

namespace stdc::kernels {
namespace {

std::vector<PosePacket> pack(const std::vector<AlignedObservation>& observations) {
  std::vector<PosePacket> packets((observations.size() + kLanes - 1) / kLanes);
  for (std::size_t i = 0; i < observations.size(); ++i) {
    PosePacket& packet = packets[i / kLanes];
    const std::size_t l = i % kLanes;
    const AlignedObservation& s = observations[i];
    packet.x[l] = s.point.x(), packet.y[l] = s.point.y(), packet.z[l] = s.point.z();
    packet.u[l] = s.pixel.x(), packet.v[l] = s.pixel.y();
    packet.inverse_sigma[l] = s.inverse_sigma, packet.inverse_depth[l] = s.inverse_depth;
    packet.depth_weight[l] = s.depth_weight;
    packet.use_pixel[l] = 1, packet.use_depth[l] = s.depth_weight > 0 ? 1 : 0;
  }
  return packets;
}

PinholeView view_of(const Pose& pose) {
  PinholeView view{{}, {}, kFx, kFy, kCx, kCy};
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(view.rotation) = pose.rotation_matrix();
  Eigen::Map<Eigen::Vector3d>(view.translation) = pose.translation;
  return view;
}

const Pose kPose = Pose::exp((Vector6d() << 0.3, -0.2, 0.5, 0.4, -0.7, 0.2).finished());

TEST(PoseKernel, PoseCostAndGradientAgreeWithDifferences) {
  const std::vector<AlignedObservation> observations = make_observations(kPose, 90, 1.0, true);
  std::vector<PosePacket> packets = pack(observations);
  PoseSystem system;
  best().linearise_pose(packets.data(), packets.size(), view_of(kPose), nullptr, &system);
  const auto total = [&](const Eigen::VectorXd& twist) {
    double sum = 0;
    for (const AlignedObservation& s : observations) sum += cost_of(s, Pose::exp(twist) * kPose, s.point);
    return Eigen::VectorXd::Constant(1, sum);
  };
  EXPECT_NEAR(system.cost, total(Vector6d::Zero())[0], 1e-9 * system.cost);
  const Eigen::RowVectorXd gradient = differentiate(6, total);
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(system.g[k], gradient[k], 1e-5 * gradient.norm()) << k;
}

TEST(PoseKernel, PoseHessianIsTheSquareOfTheJacobian) {
  const std::vector<AlignedObservation> observations = make_observations(kPose, 43, 0.1, false);
  std::vector<PosePacket> packets = pack(observations);
  PoseSystem system;
  best().linearise_pose(packets.data(), packets.size(), view_of(kPose), nullptr, &system);
  Matrix6d expected = Matrix6d::Zero();
  for (const AlignedObservation& s : observations) {
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
  std::vector<PosePacket> packets = pack(make_observations(kPose, 101, 1.0, true)), again = packets;
  PoseSystem a, b;
  const Gate gate{5.0, 3.0};
  for (const Gate* choice : {static_cast<const Gate*>(nullptr), &gate}) {
    best().linearise_pose(packets.data(), packets.size(), view_of(kPose), choice, &a);
    baseline().linearise_pose(again.data(), again.size(), view_of(kPose), choice, &b);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
    EXPECT_EQ(std::memcmp(packets.data(), again.data(), packets.size() * sizeof(PosePacket)), 0);
  }
}
}  // namespace
}  // namespace stdc::kernels
