#include "motion/flow/followed_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.hpp"

namespace stdc {
namespace {

Camera small_camera() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 525;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

/// A wall two metres away and a board before it, each of points with descriptors of their own.
class Scene {
 public:
  static constexpr int kWall = 200, kBoard = 60;

  Scene() {
    Random random(3);
    for (int i = 0; i < kWall + kBoard; ++i) {
      const bool on_board = i >= kWall;
      const double z = on_board ? 1.0 : 2.0, width = on_board ? 0.3 : 2.0, height = on_board ? 0.5 : 1.6;
      points_.emplace_back(width * (random.below(1000) / 1000.0 - 0.5),
                           height * (random.below(1000) / 1000.0 - 0.5), z);
      Descriptor descriptor;
      for (std::uint64_t& word : descriptor.bits) {
        for (int byte = 0; byte < 8; ++byte) word = word << 8 | random.below(256);
      }
      descriptors_.push_back(descriptor);
    }
  }
  /// What a camera sees once the board has moved by some metres to the right.
  PointFrame see(const Camera& camera, double timestamp, const Pose& cam_from_world, double moved) const {
    StoredFeatures stored;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      Eigen::Vector3d point = points_[i];
      if (i >= kWall) point.x() += moved;
      point = cam_from_world * point;
      const Eigen::Vector2f pixel = camera.project(point).cast<float>();
      Keypoint keypoint;
      keypoint.x = std::clamp(pixel.x(), 0.0F, 639.0F);
      keypoint.y = std::clamp(pixel.y(), 0.0F, 479.0F);
      stored.keypoints.push_back(keypoint);
      stored.descriptors.push_back(descriptors_[i]);
      stored.pixels.emplace_back(keypoint.x, keypoint.y);
      stored.depths.push_back(static_cast<float>(point.z()));
    }
    PointFrame frame;
    frame.timestamp = timestamp;
    frame.cam_from_world = cam_from_world;
    frame.map = MapId{0};
    frame.features = std::make_shared<FrameFeatures>(camera, std::move(stored));
    frame.measurements = measure_keypoints(camera, CameraMotion(camera, Vector6d::Zero()), *frame.features);
    return frame;
  }

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<Descriptor> descriptors_;
};

std::ptrdiff_t count_moving(const std::vector<PointMotion>& motion, int from, int to) {
  return std::count(motion.begin() + from, motion.begin() + to, PointMotion::moves);
}

/// The last of ten frames, 1/30 s apart, of a camera that moves along x while the board goes its own way.
std::vector<PointMotion> watch(double board_step, double pose_error) {
  const Camera camera = small_camera();
  const Scene scene;
  FollowedPoints points(camera);
  std::vector<PointMotion> motion;
  for (int i = 0; i < 10; ++i) {
    Pose cam_from_world;
    cam_from_world.translation.x() = -0.01 * i;
    PointFrame frame = scene.see(camera, i / 30.0, cam_from_world, board_step * i);
    frame.cam_from_world.translation.x() += pose_error * i;
    motion = points.add(std::move(frame));
  }
  return motion;
}

TEST(FollowedPoints, WhatRestsRests) {
  const std::vector<PointMotion> motion = watch(0, 0);
  EXPECT_EQ(count_moving(motion, 0, Scene::kWall + Scene::kBoard), 0);
  EXPECT_GT(std::count(motion.begin(), motion.end(), PointMotion::rests), 200);
}

TEST(FollowedPoints, ABoardThatKeepsItsPlaceInTheImageMoves) {
  const std::vector<PointMotion> motion = watch(0.01, 0);
  EXPECT_EQ(count_moving(motion, 0, Scene::kWall), 0);
  EXPECT_GT(count_moving(motion, Scene::kWall, Scene::kWall + Scene::kBoard), 40);
}

TEST(FollowedPoints, WhereNearlyAllSeemsToMoveThePoseIsWrong) {
  const std::vector<PointMotion> motion = watch(0, 0.02);
  EXPECT_EQ(count_moving(motion, 0, Scene::kWall + Scene::kBoard), 0);
}

}  // namespace
}  // namespace stdc
