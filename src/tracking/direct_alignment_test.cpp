#include "tracking/direct_alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/random.hpp"

namespace stdc {
namespace {

/// What a camera sees of a wall that is painted with waves of many lengths and askew.
struct Painting {
  cv::Mat grey, depth;  ///< CV_8UC1, CV_32FC1 [m]
};

class DirectAlignmentTest : public ::testing::Test {
 protected:
  DirectAlignmentTest() {
    camera.width = 320;
    camera.height = 240;
    camera.fx = camera.fy = 260;
    camera.cx = 160;
    camera.cy = 120;
    Random random(5);
    for (int i = 0; i < 40; ++i) {
      const double length = 0.05 + 0.01 * random.below(90), angle = 0.01 * random.below(314);
      waves.emplace_back(std::cos(angle) * 6.28 / length, std::sin(angle) * 6.28 / length,
                         0.01 * random.below(628));
    }
  }
  double paint(double x, double y) const {
    double sum = 0;
    for (const Eigen::Vector3d& wave : waves) sum += std::sin(wave.x() * x + wave.y() * y + wave.z());
    return 128 + 14 * sum;
  }
  Painting look(const Pose& cam_from_world) const {
    Painting seen{cv::Mat(camera.height, camera.width, CV_8UC1),
                  cv::Mat(camera.height, camera.width, CV_32FC1)};
    const Pose world_from_cam = cam_from_world.inverse();
    const Eigen::Vector3d normal = Eigen::Vector3d(0.3, 0.1, -1).normalized();
    const Eigen::Vector3d origin = world_from_cam.translation;
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const Eigen::Vector3d ray = camera.unproject(camera.undistort({x, y}), 1);
        const Eigen::Vector3d direction = world_from_cam.rotation * ray;
        const double z = normal.dot(Eigen::Vector3d(0, 0, 2) - origin) / normal.dot(direction);
        const Eigen::Vector3d p = origin + z * direction;
        seen.grey.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(paint(p.x(), p.y()));
        seen.depth.at<float>(y, x) = static_cast<float>(z);
      }
    }
    return seen;
  }
  DirectView view(const DirectAligner& aligner, const Painting& seen) const {
    auto pyramid = std::make_shared<Pyramid>();
    pyramid->build(seen.grey, FeatureSettings{});
    return {pyramid, aligner.sample(seen.depth)};
  }
  /// A step as between two frames of a fast turn.
  static Pose step() {
    Vector6d twist;
    twist << 0.02, -0.01, 0.015, 0.008, 0.05, -0.012;
    return Pose::exp(twist);
  }
  static void expect_near(const Pose& found, const Pose& truth, double rotation, double translation) {
    const Vector6d error = (found * truth.inverse()).log();
    EXPECT_LT(error.tail<3>().norm(), rotation);
    EXPECT_LT(error.head<3>().norm(), translation);
  }

  Camera camera;
  std::vector<Eigen::Vector3d> waves;
};

TEST_F(DirectAlignmentTest, FindsAFastTurnInBlurredImages) {
  const DirectAligner aligner(camera);
  Painting last = look(Pose()), now = look(step());
  cv::blur(last.grey, last.grey, {11, 1});
  cv::blur(now.grey, now.grey, {11, 1});
  const auto found = aligner.align(view(aligner, last), view(aligner, now), Pose());
  ASSERT_TRUE(found.has_value());
  expect_near(found->frame_from_last, step(), 0.001, 0.003);
  EXPECT_GT(found->depth_agreement, 0.95);
  EXPECT_GT(found->information(0, 0), 0);
}

TEST_F(DirectAlignmentTest, WorksThroughALens) {
  camera.k1 = 0.26;
  camera.k2 = -0.95;
  camera.k3 = 1.16;
  const DirectAligner aligner(camera);
  const auto found = aligner.align(view(aligner, look(Pose())), view(aligner, look(step())), Pose());
  ASSERT_TRUE(found.has_value());
  expect_near(found->frame_from_last, step(), 0.001, 0.003);
}

TEST_F(DirectAlignmentTest, ExposureMayChange) {
  const DirectAligner aligner(camera);
  Painting now = look(step());
  now.grey.convertTo(now.grey, CV_8UC1, 0.7, 25);
  const auto found = aligner.align(view(aligner, look(Pose())), view(aligner, now), Pose());
  ASSERT_TRUE(found.has_value());
  expect_near(found->frame_from_last, step(), 0.001, 0.003);
}

TEST_F(DirectAlignmentTest, WhatIsMaskedHasNoSay) {
  const DirectAligner aligner(camera);
  const Painting last = look(Pose()), turned = look(step());
  // Half of the view stays where it was in the image, as a thing carried along with the camera does.
  Painting now = turned;
  const cv::Rect carried(120, 0, 160, 240);
  last.grey(carried).copyTo(now.grey(carried));
  last.depth(carried).copyTo(now.depth(carried));
  cv::Mat mask(camera.height, camera.width, CV_8UC1, cv::Scalar(0));
  mask(carried).setTo(255);
  DirectView before = view(aligner, last), after = view(aligner, now);
  aligner.forget(mask, before.depths);
  aligner.forget(mask, after.depths);
  const auto found = aligner.align(before, after, step());
  ASSERT_TRUE(found.has_value());
  expect_near(found->frame_from_last, step(), 0.004, 0.012);
}

TEST_F(DirectAlignmentTest, FindsNothingWhereThereIsNothingToFind) {
  const DirectAligner aligner(camera);
  const Painting last = look(Pose());
  const DirectView before = view(aligner, last);
  Painting other = last;
  cv::flip(last.grey, other.grey, -1);
  EXPECT_FALSE(aligner.align(before, view(aligner, other), Pose()).has_value());
  Painting nearer = look(step());
  nearer.depth *= 0.8;
  EXPECT_FALSE(aligner.align(before, view(aligner, nearer), Pose()).has_value());
  Painting blind = last;
  blind.depth.setTo(0);
  EXPECT_FALSE(aligner.align(view(aligner, blind), before, Pose()).has_value());
  blind.depth.release();
  EXPECT_FALSE(aligner.align(view(aligner, blind), before, Pose()).has_value());
  Painting grey = last;
  grey.grey.setTo(90);
  EXPECT_FALSE(aligner.align(view(aligner, grey), view(aligner, grey), Pose()).has_value());
}

}  // namespace
}  // namespace stdc
