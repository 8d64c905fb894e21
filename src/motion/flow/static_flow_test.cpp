#include "motion/flow/static_flow.hpp"

#include <gtest/gtest.h>

#include "core/pose.hpp"
#include "core/random.hpp"

namespace stdc {
namespace {

constexpr double kPixel = 1 / 525.0;

/// Points at many depths before a camera that moves; the last `moving` of them move by themselves.
std::vector<FlowPoint> make_points(const Pose& there_from_here, int count, int moving, double noise) {
  Random random(3);
  std::vector<FlowPoint> points;
  for (int i = 0; i < count; ++i) {
    FlowPoint point;
    point.here = {random.uniform(-0.6, 0.6), random.uniform(-0.45, 0.45)};
    const double depth = random.uniform(0.8, 5);
    point.inverse_depth = point.min_inverse_depth = point.max_inverse_depth = 1 / depth;
    Eigen::Vector3d at = depth * point.here.homogeneous();
    if (i >= count - moving) at.x() += 0.08;
    point.there = (there_from_here * at).hnormalized();
    point.there += noise * Eigen::Vector2d(random.normal(), random.normal());
    points.push_back(point);
  }
  return points;
}

TEST(StaticFlow, TellsWhatMovesFromParallax) {
  const Pose motion(rotation_exp({0.02, -0.03, 0.01}), {0.06, -0.02, 0.03});
  const auto points = make_points(motion, 200, 50, 0.2 * kPixel);
  const auto flow = fit_static_flow(points, kPixel, 1);
  ASSERT_TRUE(flow);
  EXPECT_LT((flow->parallax - motion.translation).norm(), 0.003);
  for (int i = 0; i < 150; ++i) EXPECT_LT(flow->residual(points[static_cast<std::size_t>(i)]), 2 * kPixel);
  for (int i = 150; i < 200; ++i) EXPECT_GT(flow->residual(points[static_cast<std::size_t>(i)]), 2 * kPixel);
}

TEST(StaticFlow, APointWithoutDepthIsHeldAgainstItsEpipolarLine) {
  StaticFlow flow;
  flow.parallax = {0.05, 0, 0};
  FlowPoint point;
  point.there = {0.04, 0};
  EXPECT_NEAR(flow.residual(point), 0, 1e-12);
  point.there = {0.04, 0.01};
  EXPECT_NEAR(flow.residual(point), 0.01, 1e-12);
  point.there = {-0.02, 0};  // beyond infinity
  EXPECT_NEAR(flow.residual(point), 0.02, 1e-12);
}

TEST(StaticFlow, AlongAnEdgeNothingIsSeen) {
  StaticFlow flow;
  FlowPoint point;
  point.inverse_depth = point.min_inverse_depth = point.max_inverse_depth = 1;
  point.there = {0.01, 0};
  point.certainty = Eigen::Vector2d(0, 1).asDiagonal();
  EXPECT_EQ(flow.residual(point), 0);
}

TEST(StaticFlow, FewPointsTellNothing) {
  EXPECT_FALSE(fit_static_flow(make_points(Pose(), 15, 0, 0), kPixel, 1));
  EXPECT_FALSE(fit_static_flow({}, kPixel, 1));
}

TEST(StaticFlow, SameSeedSameBytes) {
  const auto points = make_points(Pose(rotation_exp({0, 0.02, 0}), {0.05, 0, 0}), 100, 40, 0.5 * kPixel);
  const auto a = fit_static_flow(points, kPixel, 1), b = fit_static_flow(points, kPixel, 1);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->homography, b->homography);
  EXPECT_EQ(a->parallax, b->parallax);
}

}  // namespace
}  // namespace stdc
