#include "estimation/se3.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace stdc {
namespace {

Vector6d random_twist(Random& random, double metres, double radians) {
  Vector6d twist;
  for (int i = 0; i < 6; ++i) twist[i] = random.uniform(-1, 1) * (i < 3 ? metres : radians);
  return twist;
}

TEST(Se3, TheInverseLeftJacobianIsTheDerivativeOfTheLogarithm) {
  Random random(1);
  for (const double radians : {0.0, 0.01, 0.3, 1.0, 1.6}) {
    const Vector6d error = random_twist(random, 1.0, radians);
    const Matrix6d jacobian = inverse_left_jacobian(error);
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 6; ++k) {
      const Vector6d step = kStep * Vector6d::Unit(k);
      const Vector6d numeric =
          ((Pose::exp(step) * Pose::exp(error)).log() - (Pose::exp(-step) * Pose::exp(error)).log()) /
          (2 * kStep);
      EXPECT_LT((jacobian.col(k) - numeric).norm(), radians > 1 ? 0.02 : 1e-4) << radians;
    }
  }
}

TEST(Se3, TheAdjointTakesATwistToTheOtherSide) {
  Random random(2);
  for (int n = 0; n < 20; ++n) {
    const Pose pose = Pose::exp(random_twist(random, 2, 2));
    const Vector6d twist = random_twist(random, 0.5, 0.5);
    const Pose one = pose * Pose::exp(twist), other = Pose::exp(adjoint(pose) * twist) * pose;
    EXPECT_LT((one * other.inverse()).log().norm(), 1e-12);
  }
}

}  // namespace
}  // namespace stdc
