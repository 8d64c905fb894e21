#include "core/camera_motion.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

TEST(CameraMotion, SeesAPointWhereARowByRowSearchDoes) {
  Camera camera;
  camera.readout_time = 0.03;
  Vector6d twist;
  twist << 0.3, -0.2, 0.1, 0.5, -0.8, 0.4;
  const CameraMotion motion(camera, twist);
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(0.2, -0.5, 1.5), Eigen::Vector3d(-0.7, 0.6, 2.0)}) {
    // The row at which the true (not linearised) motion puts the point on the row being read.
    Eigen::Vector2d seen(0, 0);
    double least = 1e9;
    for (double row = 0; row < 480; row += 0.01) {
      const Eigen::Vector2d pixel = camera.project(Pose::exp(twist * motion.row_time(row)) * point);
      if (std::abs(pixel.y() - row) >= least) continue;
      least = std::abs(pixel.y() - row);
      seen = pixel;
    }
    EXPECT_LT((motion.project(camera, point) - seen).norm(), 0.1);
  }
}

TEST(CameraMotion, AtMiddleUndoesLater) {
  Camera camera;
  camera.readout_time = 0.03;
  Vector6d twist;
  twist << 0.3, -0.2, 0.1, 0.5, -0.8, 0.4;
  const CameraMotion motion(camera, twist);
  const Eigen::Vector3d point(0.4, 0.3, 2);
  EXPECT_LT((motion.at_middle(motion.later(point, 0.015), 0.015) - point).norm(), 1e-3);
}

TEST(CameraMotion, WithoutAReadoutTimeNothingMoves) {
  const Camera camera;
  const CameraMotion motion(camera, Vector6d::Constant(1));
  const Eigen::Vector3d point(0.4, 0.3, 2);
  EXPECT_EQ(motion.project(camera, point), camera.project(point));
}

}  // namespace
}  // namespace stdc
