#include "core/pose.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace stdc {
namespace {

Vector6d random_twist(Random& random, double scale) {
  Vector6d twist;
  for (int i = 0; i < 6; ++i) twist[i] = scale * random.normal();
  return twist;
}

TEST(Pose, ExpAndLogAreInverse) {
  Random random(1);
  for (double scale : {1e-9, 1e-5, 1e-2, 0.7}) {
    for (int i = 0; i < 50; ++i) {
      const Vector6d twist = random_twist(random, scale);
      EXPECT_LT((Pose::exp(twist).log() - twist).norm(), 1e-12 + 1e-9 * scale);
    }
  }
}

TEST(Pose, InverseUndoes) {
  Random random(2);
  const Pose pose = Pose::exp(random_twist(random, 1.0));
  const Eigen::Vector3d point(0.3, -2, 5);
  EXPECT_LT(((pose.inverse() * pose) * point - point).norm(), 1e-12);
  EXPECT_LT((pose * pose.centre()).norm(), 1e-12);
}

TEST(Pose, ComposesInReadingOrder) {
  Random random(3);
  const Pose b_from_a = Pose::exp(random_twist(random, 1.0));
  const Pose c_from_b = Pose::exp(random_twist(random, 1.0));
  const Eigen::Vector3d p(1, 2, 3);
  EXPECT_LT(((c_from_b * b_from_a) * p - c_from_b * (b_from_a * p)).norm(), 1e-12);
}

}  // namespace
}  // namespace stdc
