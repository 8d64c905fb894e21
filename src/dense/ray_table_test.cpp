#include "dense/ray_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dense/inpainting/test_plane.hpp"

namespace stdc {
namespace {

Camera with_lens() {
  Camera camera = test::PlaneScene::camera();
  camera.k1 = 0.1, camera.p1 = 0.001, camera.p2 = -0.002;  // its image shows all that the ideal one has
  return camera;
}

TEST(RayTable, APointOnTheRayOfAPixelIsSeenThere) {
  for (const Camera& camera : {test::PlaneScene::camera(), with_lens()}) {
    const RayTable rays(camera);
    EXPECT_EQ(rays.size(), cv::Size(camera.width, camera.height));
    for (int y = 0; y < camera.height; y += 17) {
      for (int x = 0; x < camera.width; x += 13) {
        const Eigen::Vector3f point = rays.point(x, y, 1.7F);
        EXPECT_FLOAT_EQ(point.z(), 1.7F);
        const Eigen::Vector2f pixel = rays.project(point);
        EXPECT_NEAR(pixel.x(), x, 0.02);
        EXPECT_NEAR(pixel.y(), y, 0.02);
      }
    }
  }
}

TEST(RayTable, TheLensCountsInBothDirections) {
  const RayTable straight(test::PlaneScene::camera()), bent(with_lens());
  EXPECT_GT(std::abs(straight.ray(0, 0)[0] - bent.ray(0, 0)[0]), 0.002);
  const Eigen::Vector3f point = straight.point(0, 0, 2);
  EXPECT_GT((straight.project(point) - bent.project(point)).norm(), 0.5);
}

TEST(RayTable, WhatALensDoesNotShowIsProjectedFarOutside) {
  const RayTable rays(with_lens());
  const Eigen::Vector2f pixel = rays.project({30, 0, 1});
  EXPECT_LT(pixel.x(), -1000);
  EXPECT_LT(pixel.y(), -1000);
}

}  // namespace
}  // namespace stdc
