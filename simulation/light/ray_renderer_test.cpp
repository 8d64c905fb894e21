#include "simulation/light/ray_renderer.hpp"

#include <gtest/gtest.h>

#include "simulation/light/test_plain_world.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

/// A rectangle that moves before the wall.
class MovingBoard : public MovingObjects {
 public:
  explicit MovingBoard(bool moves) : moves_(moves) {
    ShapeBuilder(mesh_, materials_, 1).rectangle({-0.4, 1.5, -0.3}, {0.9, 0, 0}, {0, 0.2, 0.7}, {});
    scene_.emplace(mesh_, TreeQuality::fast);
  }
  bool trace(const Vector3f& origin, const Vector3f* directions, int count, Hit* hits) const override {
    return scene_->trace(origin, directions, count, hits);
  }
  Shade shade(const Hit&, const Vector3f&, const Vector3f&, float) const override {
    return {Rgb(0.5F, 0, 0), 0.7F};
  }
  std::uint32_t surface(const Hit&) const override { return 1; }
  bool dynamic(const Hit&) const override { return moves_; }
  float shadow(const Vector3f&, const Vector3f&) const override { return 1; }

 private:
  bool moves_;
  Mesh mesh_;
  std::vector<Material> materials_{Material()};
  std::optional<RayScene> scene_;
};

Camera wide_camera() {
  Camera camera;
  camera.width = 96;
  camera.height = 72;
  camera.fx = camera.fy = 70;
  camera.cx = 47.3;
  camera.cy = 36.1;
  camera.k1 = -0.1;
  camera.p1 = 0.002;
  return camera;
}

/// Depth z at which the ray of a raw pixel meets a plane, and where.
std::pair<double, Vector3d> meet(const Camera& camera, const Pose& world_from_cam, int x, int y,
                                 const Vector3d& on_plane, const Vector3d& normal) {
  const Vector3d ray = world_from_cam.rotation * camera.unproject(camera.undistort(Vector2d(x, y)), 1);
  const double z = normal.dot(on_plane - world_from_cam.translation) / normal.dot(ray);
  return {z, world_from_cam.translation + z * ray};
}

class RayRendererTest : public testing::Test {
 protected:
  RayRendererTest() {
    ShapeBuilder(world_.mesh, world_.materials, 1).rectangle({-9, 3, -9}, {18, 0, 0}, {0, 1, 18}, {});
    scene_.emplace(world_.mesh, TreeQuality::good);
    light_.emplace(world_, *scene_);
    shader_.emplace(world_, *light_);
  }
  IdealImage render(const MovingObjects* moving) const {
    return RayRenderer(rays_, *scene_, *shader_).render(world_from_cam_, moving);
  }
  std::pair<double, Vector3d> wall(int x, int y) const {
    return meet(camera_, world_from_cam_, x, y, {-9, 3, -9}, Vector3d(18, 0, 0).cross(Vector3d(0, 1, 18)));
  }

  const Camera camera_ = wide_camera();
  // Looks along +y of the world, a little upward and aside.
  const Pose world_from_cam_{Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Vector3d::UnitZ()) *
                                                Eigen::AngleAxisd(-1.5, Vector3d::UnitX())),
                             Vector3d(0.2, -0.3, 0.1)};
  World world_ = test::plain_world();
  RayGrid rays_{camera_};
  std::optional<RayScene> scene_;
  std::optional<BakedLight> light_;
  std::optional<SurfaceShader> shader_;
};

TEST_F(RayRendererTest, DepthIsThatOfTheRayThroughThePixel) {
  const IdealImage image = render(nullptr);
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      EXPECT_NEAR(image.depth.at<float>(y, x), wall(x, y).first, 2e-6 * wall(x, y).first) << x << "," << y;
      EXPECT_EQ(image.mask.at<std::uint8_t>(y, x), 0);
    }
  }
}

TEST_F(RayRendererTest, TheMaskHoldsExactlyThePixelsOfWhatMoves) {
  const MovingBoard board(true);
  const IdealImage image = render(&board);
  const Vector3d corner(-0.4, 1.5, -0.3), s(0.9, 0, 0), t(0, 0.2, 0.7);
  int covered = 0;
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      const auto [z, at] = meet(camera_, world_from_cam_, x, y, corner, s.cross(t));
      const double u = (at - corner).dot(s) / s.squaredNorm(), v = (at - corner).dot(t) / t.squaredNorm();
      const bool hit = u >= 0 && u <= 1 && v >= 0 && v <= 1;
      EXPECT_EQ(image.mask.at<std::uint8_t>(y, x), hit ? 255 : 0) << x << "," << y;
      EXPECT_NEAR(image.depth.at<float>(y, x), hit ? z : wall(x, y).first, 1e-5) << x << "," << y;
      EXPECT_EQ(image.infrared.at<float>(y, x) == 0.7F, hit) << x << "," << y;
      covered += hit ? 1 : 0;
    }
  }
  EXPECT_GT(covered, 500);
}

TEST_F(RayRendererTest, WhatRestsIsSeenButNotInTheMask) {
  const MovingBoard moving(true), resting(false);
  const IdealImage a = render(&moving), b = render(&resting);
  EXPECT_EQ(cv::countNonZero(b.mask), 0);
  EXPECT_EQ(cv::norm(a.depth, b.depth, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(a.colour, b.colour, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace stdc::simulation
