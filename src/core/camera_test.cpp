#include "core/camera.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace stdc {
namespace {

Camera freiburg1() {
  return {640,      480,       517.306408, 516.469215, 318.643040, 255.313989,
          0.262383, -0.953104, -0.005358,  0.002628,   1.163314};
}

TEST(Camera, UndistortInvertsDistortOverTheWholeImage) {
  const Camera camera = freiburg1();
  for (int v = 0; v < camera.height; v += 13) {
    for (int u = 0; u < camera.width; u += 11) {
      const Eigen::Vector2d raw(u, v);
      EXPECT_LT((camera.distort(camera.undistort(raw)) - raw).norm(), 1e-6) << u << " " << v;
    }
  }
}

TEST(Camera, UnprojectInvertsProject) {
  const Camera camera = freiburg1();
  const Eigen::Vector3d point(0.4, -0.3, 2.5);
  EXPECT_LT((camera.unproject(camera.project(point), 2.5) - point).norm(), 1e-12);
}

TEST(Camera, RefusesNonsense) {
  Camera camera = freiburg1();
  camera.fx = -1;
  EXPECT_THROW(camera.validate("camera.yaml"), Error);
  camera = freiburg1();
  camera.k1 = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(camera.validate("camera.yaml"), Error);
}

}  // namespace
}  // namespace stdc
