#include "input/registration/depth_registration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/every_target.hpp"

namespace stdc {
namespace {

Camera camera_of(int width, int height, double focal) {
  Camera camera;
  camera.width = width, camera.height = height, camera.fx = camera.fy = focal;
  camera.cx = 0.5 * (width - 1), camera.cy = 0.5 * (height - 1);
  camera.depth_units_per_metre = 1000;
  return camera;
}

/// As between the imagers of a RealSense D435.
DepthCamera wide_depth_camera() {
  DepthCamera depth;
  depth.camera = camera_of(848, 480, 424);
  depth.colour_from_depth.translation = {0.015, 0, 0};
  return depth;
}

/// Depth image of a camera before planes, by casting a ray through each pixel; `plane(ray)` gives z.
template <typename Plane>
cv::Mat cast(const Camera& camera, const Plane& plane) {
  cv::Mat depth(camera.height, camera.width, CV_16UC1);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d ray = camera.unproject(camera.undistort(Eigen::Vector2d(x, y)), 1);
      depth.at<std::uint16_t>(y, x) =
          static_cast<std::uint16_t>(std::lround(camera.depth_units_per_metre * plane(ray)));
    }
  }
  return depth;
}

int holes(const cv::Mat& depth) { return static_cast<int>(depth.total()) - cv::countNonZero(depth); }

TEST(DepthRegistration, TheSameCameraGivesTheSameImage) {
  DepthCamera depth;
  depth.camera = camera_of(160, 120, 140);
  const cv::Mat image = cast(depth.camera, [](const Eigen::Vector3d& ray) { return 2 + 0.3 * ray.x(); });
  const cv::Mat registered = DepthRegistration(depth, depth.camera).apply(image);
  EXPECT_EQ(cv::norm(registered, image, cv::NORM_INF), 0);
}

TEST(DepthRegistration, AWallIsWholeAndWhereItIs) {
  const Camera colour = camera_of(640, 480, 615);
  const DepthCamera depth = wide_depth_camera();
  // z = 2 m in both cameras, which have no rotation between them.
  const cv::Mat wall = cast(depth.camera, [](const Eigen::Vector3d&) { return 2.0; });
  const cv::Mat registered = DepthRegistration(depth, colour).apply(wall);
  ASSERT_EQ(registered.size(), cv::Size(640, 480));
  EXPECT_EQ(holes(registered), 0);
  EXPECT_EQ(cv::norm(registered, cv::Mat(480, 640, CV_16UC1, cv::Scalar(2000)), cv::NORM_INF), 0);
}

TEST(DepthRegistration, ASlantedSurfaceHasNoCracksAndNoBackgroundInIt) {
  const Camera colour = camera_of(640, 480, 615);
  DepthCamera depth = wide_depth_camera();
  depth.colour_from_depth.rotation = rotation_exp({0.01, -0.02, 0.005});
  depth.colour_from_depth.translation = {0.05, -0.01, 0.004};
  // z = 1.5 + 0.4 x in the depth camera, half a metre and more before nothing at all.
  const Eigen::Vector3d normal = Eigen::Vector3d(-0.4, 0, 1).normalized();
  const double distance = 1.5 * normal.z();
  const auto plane_in = [](const Eigen::Vector3d& n, double d) {
    return [n, d](const Eigen::Vector3d& ray) { return d / n.dot(ray); };
  };
  const cv::Mat image = cast(depth.camera, plane_in(normal, distance));
  const cv::Mat registered = DepthRegistration(depth, colour).apply(image);
  const Eigen::Vector3d turned = depth.colour_from_depth.rotation * normal;
  const cv::Mat truth =
      cast(colour, plane_in(turned, distance + turned.dot(depth.colour_from_depth.translation)));
  EXPECT_EQ(holes(registered), 0);
  // The nearer of two neighbours wins: up to a pixel of the depth camera away from the ray.
  EXPECT_LT(cv::norm(registered, truth, cv::NORM_INF), 4);
}

TEST(DepthRegistration, WhatStandsInFrontHidesWhatIsBehindAndLeavesAHoleBeside) {
  const Camera colour = camera_of(640, 480, 615);
  const DepthCamera depth = wide_depth_camera();
  const auto scene = [](const Eigen::Vector3d& ray) { return std::abs(ray.x()) < 0.2 ? 0.6 : 3.0; };
  const cv::Mat registered = DepthRegistration(depth, colour).apply(cast(depth.camera, scene));
  // The post, 1.5 cm to the right in the colour camera: from -0.2 + 0.025 to 0.2 + 0.025 of the axis; the
  // wall moves by 0.005, so that on one side it is covered and on the other it was never seen.
  const auto column = [&](double x) { return static_cast<int>(std::lround(colour.fx * x + colour.cx)); };
  for (int x = column(-0.175) + 2; x < column(0.225) - 2; ++x)
    ASSERT_EQ(registered.at<std::uint16_t>(240, x), 600);
  for (int x = column(-0.195) + 2; x < column(-0.175) - 2; ++x)
    ASSERT_EQ(registered.at<std::uint16_t>(240, x), 0);
  for (int x = column(0.225) + 2; x < 640; ++x) ASSERT_EQ(registered.at<std::uint16_t>(240, x), 3000);
}

TEST(DepthRegistration, FollowsTheLensesOfBothCameras) {
  Camera colour = camera_of(640, 480, 615);
  colour.k1 = 0.12, colour.k2 = -0.25, colour.p1 = 1e-3;
  DepthCamera depth = wide_depth_camera();
  depth.camera.lens = LensModel::equidistant;
  depth.camera.k1 = 0.02;
  depth.colour_from_depth.translation = {0.03, 0, 0};
  const auto plane = [](const Eigen::Vector3d& ray) { return 1 / (0.5 + 0.2 * ray.y()); };
  const cv::Mat registered = DepthRegistration(depth, colour).apply(cast(depth.camera, plane));
  EXPECT_EQ(holes(registered), 0);
  EXPECT_LT(cv::norm(registered, cast(colour, plane), cv::NORM_INF), 4) << "the shift is along the plane";
}

TEST(DepthRegistration, HolesStayHolesAndMetresStayMetres) {
  DepthCamera depth;
  depth.camera = camera_of(160, 120, 140);
  cv::Mat image(120, 160, CV_32FC1, cv::Scalar(1.25));
  image(cv::Rect(40, 40, 20, 10)).setTo(0);
  image(cv::Rect(80, 40, 20, 10)).setTo(NAN);
  image(cv::Rect(80, 80, 20, 10)).setTo(-1);
  const cv::Mat registered = DepthRegistration(depth, depth.camera).apply(image);
  EXPECT_EQ(registered.type(), CV_32FC1);
  EXPECT_EQ(holes(registered), 600);
  EXPECT_FLOAT_EQ(registered.at<float>(10, 10), 1.25F);
}

/// A room with steps of depth and holes.
cv::Mat stepped_room(const Camera& camera) {
  cv::Mat depth(camera.height, camera.width, CV_16UC1, cv::Scalar(3000));
  for (int i = 0; i < 12; ++i) {
    const cv::Rect box(i * camera.width / 12, (i * 5 % 7) * camera.height / 9, camera.width / 15,
                       camera.height / 5);
    depth(box).setTo(i % 4 == 3 ? 0 : 900 + 150 * i);
  }
  return depth;
}

TEST(DepthRegistration, GivesTheSameBytesWithEveryInstructionSet) {
  Camera colour = camera_of(641, 480, 615);  // not a whole number of vectors
  colour.k1 = 0.12, colour.k2 = -0.25, colour.p1 = 1e-3, colour.p2 = -5e-4, colour.k4 = 0.05;
  DepthCamera depth = wide_depth_camera();
  depth.camera = camera_of(845, 480, 424);
  depth.colour_from_depth.rotation = rotation_exp({0.01, -0.02, 0.005});
  const DepthRegistration registration(depth, colour);
  const cv::Mat units = stepped_room(depth.camera);
  cv::Mat metres;
  units.convertTo(metres, CV_32F, 0.001);
  cv::Mat first_units, first_metres;
  test::on_every_target([&] {
    const cv::Mat in_units = registration.apply(units), in_metres = registration.apply(metres);
    if (first_units.empty()) first_units = in_units, first_metres = in_metres;
    EXPECT_EQ(cv::norm(in_units, first_units, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(in_metres, first_metres, cv::NORM_INF), 0);
  });
}

TEST(LensRows, MovePixelsAsTheCameraDoes) {
  Camera usual = camera_of(640, 480, 525);
  usual.k1 = 0.23, usual.k2 = -0.78, usual.p1 = -2e-3, usual.p2 = 2e-3, usual.k3 = 0.92;  // fr1's
  Camera rational = usual;
  rational.k4 = 0.1, rational.k5 = -0.2, rational.k6 = 0.05;
  Camera fisheye = camera_of(640, 480, 300);
  fisheye.lens = LensModel::equidistant;
  fisheye.k1 = 0.02;
  for (const Camera& camera : {usual, rational, fisheye, camera_of(640, 480, 525)}) {
    const LensRows rows(camera);
    constexpr int kPixelStep = 7;
    for (int y = 0; y < camera.height; y += kPixelStep) {
      std::vector<float> u(640 + kRegistrationPadding), v(640 + kRegistrationPadding);
      for (int x = 0; x < camera.width; ++x) {
        const Eigen::Vector2d ideal = camera.undistort(Eigen::Vector2d(x, y));
        u[static_cast<std::size_t>(x)] = static_cast<float>(ideal.x());
        v[static_cast<std::size_t>(x)] = static_cast<float>(ideal.y());
      }
      rows.distort(u.data(), v.data(), 640);
      for (int x = 0; x < camera.width; ++x) {
        ASSERT_NEAR(u[static_cast<std::size_t>(x)], x, 0.01) << x << " " << y;
        ASSERT_NEAR(v[static_cast<std::size_t>(x)], y, 0.01) << x << " " << y;
      }
    }
  }
}

TEST(LensRows, NothingLiesWhereThePolynomialFoldsBack) {
  Camera camera = camera_of(640, 480, 525);
  camera.k1 = -0.3;  // folds at a radius of 1.05, far outside the image
  const LensRows rows(camera);
  std::vector<float> u(32 + kRegistrationPadding, 319.5F + 525 * 1.8F), v(32 + kRegistrationPadding, 239.5F);
  rows.distort(u.data(), v.data(), 32);
  for (int i = 0; i < 32; ++i) EXPECT_TRUE(std::isnan(u[static_cast<std::size_t>(i)]));
}

}  // namespace
}  // namespace stdc
