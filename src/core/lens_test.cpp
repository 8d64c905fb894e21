#include "core/lens.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/camera.hpp"
#include "core/error.hpp"
#include "core/files/test_folder.hpp"

namespace stdc {
namespace {

using Eigen::Vector2d;

Camera pinhole(int width, int height, double focal) {
  Camera camera;
  camera.width = width, camera.height = height;
  camera.fx = focal, camera.fy = focal * 1.01;
  camera.cx = 0.49 * width, camera.cy = 0.51 * height;
  return camera;
}

Camera tele() {  // a Kinect's colour camera
  Camera c = pinhole(640, 480, 517);
  c.k1 = 0.26, c.k2 = -0.95, c.p1 = -0.005, c.p2 = 0.003, c.k3 = 1.16;
  return c;
}

Camera
rational() {  // large coefficients that all but cancel each other, as makers of depth cameras give them
  Camera c = pinhole(320, 180, 152);
  c.k1 = 0.5, c.k2 = -2.7, c.p1 = 0.0005, c.p2 = -0.0002, c.k3 = 1.5;
  c.k4 = 0.38, c.k5 = -2.5, c.k6 = 1.43;
  return c;
}

Camera fisheye(double field_of_view) {
  Camera c = pinhole(640, 480, 320 / (0.5 * field_of_view * std::numbers::pi / 180));
  c.lens = LensModel::equidistant;
  c.k1 = 0.02, c.k2 = -0.006, c.k3 = 0.002, c.k4 = -0.0004;
  return c;
}

Camera barrel() {  // five coefficients, wide
  Camera c = pinhole(640, 480, 300);
  c.k1 = -0.2, c.k2 = 0.035, c.k3 = -0.0022;
  return c;
}

Lens lens_of(const Camera& c) {
  return {
      c.lens == LensModel::equidistant, c.k1, c.k2, c.p1, c.p2, c.k3, c.k4, c.k5, c.k6, Camera::kMaxAngle};
}

std::string refusal(const Camera& camera) {
  return test::message_of([&] { camera.validate("c.yaml"); });
}

TEST(Lens, UndistortInvertsDistortOverTheWholeImage) {
  for (const Camera& camera : {tele(), rational(), fisheye(120), fisheye(150), barrel()}) {
    ASSERT_EQ(refusal(camera), "");
    for (int v = 0; v < camera.height; v += 7) {
      for (int u = 0; u < camera.width; u += 9) {
        const Vector2d raw(u, v);
        if (!camera.has_ideal(raw)) continue;
        EXPECT_LT((camera.distort(camera.undistort(raw)) - raw).norm(), 1e-6)
            << camera.lens_name() << " " << u << " " << v;
      }
    }
  }
}

TEST(Lens, TheJacobianIsTheDerivative) {
  for (const Camera& camera : {tele(), rational(), fisheye(120), barrel()}) {
    for (const Vector2d& n : {Vector2d(0.1, 0.2), Vector2d(-0.4, 0.3), Vector2d(0, 0.5), Vector2d(0, 0)}) {
      Eigen::Matrix2d jacobian, numeric;
      distort_normalised(lens_of(camera), n, &jacobian);
      constexpr double kStep = 1e-6;
      for (int i = 0; i < 2; ++i) {
        const Vector2d beside = kStep * Vector2d::Unit(i);
        numeric.col(i) = (distort_normalised(lens_of(camera), n + beside, nullptr) -
                          distort_normalised(lens_of(camera), n - beside, nullptr)) /
                         (2 * kStep);
      }
      EXPECT_LT((jacobian - numeric).norm(), 1e-8) << camera.lens_name() << " " << n.transpose();
    }
  }
}

TEST(Lens, RationalIsOpenCvsFormula) {
  const Camera c = rational();
  const double x = 0.3, y = -0.2, r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
  const double radial = (1 + c.k1 * r2 + c.k2 * r4 + c.k3 * r6) / (1 + c.k4 * r2 + c.k5 * r4 + c.k6 * r6);
  const Vector2d raw = distort_normalised(lens_of(c), {x, y}, nullptr);
  EXPECT_NEAR(raw.x(), x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x), 1e-15);
  EXPECT_NEAR(raw.y(), y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y, 1e-15);
}

TEST(Lens, EquidistantIsProportionalToTheAngle) {
  Camera c = fisheye(120);
  c.k1 = c.k2 = c.k3 = c.k4 = 0;
  for (const double degrees : {1.0, 20.0, 59.0, 80.0}) {
    const double theta = degrees * std::numbers::pi / 180;
    EXPECT_NEAR(distort_normalised(lens_of(c), {std::tan(theta), 0}, nullptr).x(), theta, 1e-12);
    EXPECT_NEAR(undistort_normalised(lens_of(c), {0, theta}).y(), std::tan(theta), 1e-9);
  }
  c.k1 = 0.1;  // and the coefficients are those of odd powers
  EXPECT_NEAR(distort_normalised(lens_of(c), {std::tan(0.5), 0}, nullptr).x(), 0.5 + 0.1 * 0.125, 1e-12);
}

TEST(Lens, WhatIsBesideACameraHasNoIdealPixel) {
  const Camera camera = fisheye(200);
  EXPECT_EQ(refusal(camera), "");
  EXPECT_TRUE(camera.has_ideal({camera.cx, camera.cy}));
  EXPECT_FALSE(camera.has_ideal({0, 0}));
  EXPECT_TRUE(camera.undistort({0, 0}).allFinite());
}

TEST(Lens, ALensThatFoldsInsideTheImageIsRefused) {
  Camera camera = rational();
  camera.k4 = camera.k5 = camera.k6 = 0;  // five of eight
  const std::string message = refusal(camera);
  EXPECT_EQ(message.find("c.yaml: the lens distortion folds back at pixel ("), 0U) << message;
  EXPECT_NE(message.find("of the image (radial-tangential lens); give all coefficients"), std::string::npos);
  const auto fault =
      find_lens_fault(lens_of(camera), {{320, 180}, {camera.fx, camera.fy}, {camera.cx, camera.cy}});
  ASSERT_TRUE(fault);
  EXPECT_GT(fault->raw.x(), 0);
  EXPECT_LT(fault->raw.x(), camera.width);

  camera = barrel();
  camera.k2 = camera.k3 = 0, camera.k1 = -0.4;
  EXPECT_NE(refusal(camera).find("folds back"), std::string::npos);
  camera = fisheye(120);
  camera.k1 = -0.5;
  EXPECT_NE(refusal(camera).find("(equidistant lens)"), std::string::npos);
  camera = pinhole(640, 480, 300);
  camera.k4 = -0.8;
  EXPECT_EQ(refusal(camera), "") << "its pole is at infinity, beyond the edge";
  camera.k4 = 5, camera.k5 = 4;  // flattens out before it comes to the edge
  EXPECT_NE(refusal(camera), "");
}

TEST(Lens, AFoldBeyondTheImageDoesNoHarm) {
  Camera camera = pinhole(640, 480, 500);
  camera.k1 = -0.15;  // folds at r = 1.49, seen at 0.99; the corner is at 0.81
  EXPECT_EQ(refusal(camera), "");
  for (int u = 0; u < camera.width; u += 9) {
    const Vector2d raw(u, 0);
    EXPECT_LT((camera.distort(camera.undistort(raw)) - raw).norm(), 1e-6) << u;
    EXPECT_LT((camera.undistort(raw) - Vector2d(camera.cx, camera.cy)).norm(), 1.49 * 500);
  }
}

TEST(Lens, WhatTheImageShowsMayLieOutsideTheIdealRectangle) {
  const Camera camera = fisheye(120);
  const Vector2d edge = camera.undistort({3, 240});
  EXPECT_LT(edge.x(), -100);
  EXPECT_TRUE(camera.shows(edge));
  EXPECT_FALSE(camera.shows(camera.undistort({-3, 240})));
  EXPECT_FALSE(pinhole(640, 480, 500).shows({-1, 3}));
  Camera folding = pinhole(640, 480, 500);
  folding.k1 = -0.3;
  EXPECT_FALSE(folding.shows({folding.cx + 500 * std::sqrt(1 / 0.3), folding.cy}))
      << "folded onto the centre";
}

TEST(Lens, NonsenseIsRefused) {
  Camera camera = fisheye(120);
  camera.p1 = 0.1;
  EXPECT_NE(refusal(camera).find("an equidistant lens has k1, k2, k3, k4 only"), std::string::npos);
  camera = tele();
  camera.k6 = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal(camera), "");
  camera = tele();
  camera.rotation = 45;
  EXPECT_NE(refusal(camera).find("rotation is none of 0, 90, 180, 270"), std::string::npos);
}

}  // namespace
}  // namespace stdc
