#include "features/frame_features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace stdc {
namespace {

Features random_features(int count, std::uint64_t seed) {
  Random random(seed);
  Features features;
  for (int i = 0; i < count; ++i) {
    Keypoint keypoint;
    keypoint.x = static_cast<float>(random.uniform(0, 639));
    keypoint.y = static_cast<float>(random.uniform(0, 479));
    keypoint.level = static_cast<std::uint8_t>(random.below(6));
    features.keypoints.push_back(keypoint);
  }
  features.descriptors.resize(count);
  return features;
}

TEST(FrameFeatures, WindowFindsWhatASearchOfAllFinds) {
  Camera camera;
  camera.k1 = 0.2;  // pushes ideal pixels about, some out of the image
  const FrameFeatures frame(camera, random_features(800, 1), {}, 1.2, 6, nullptr);
  Random random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const float x = static_cast<float>(random.uniform(-50, 700)),
                y = static_cast<float>(random.uniform(-50, 520));
    const float radius = static_cast<float>(random.uniform(1, 60));
    std::vector<int> found, expected;
    frame.for_each_in_window(x, y, radius, 1, 4, [&](int i) { found.push_back(i); });
    for (int i = 0; i < frame.size(); ++i) {
      const int level = frame.keypoint(i).level;
      if (level >= 1 && level <= 4 && std::abs(frame.pixel(i).x() - x) <= radius &&
          std::abs(frame.pixel(i).y() - y) <= radius) {
        expected.push_back(i);
      }
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(FrameFeatures, ReadsDepthOfBothKindsAndMarksTheMissing) {
  cv::Mat units(480, 640, CV_16UC1, cv::Scalar(10000)), metres(480, 640, CV_32FC1, cv::Scalar(2));
  units.at<std::uint16_t>(5, 7) = 0;
  metres.at<float>(5, 7) = std::numeric_limits<float>::quiet_NaN();
  for (const cv::Mat& image : {units, metres}) {
    EXPECT_FLOAT_EQ(depth_at(image, 5000, 100, 100), 2);
    EXPECT_EQ(depth_at(image, 5000, 7, 5), 0);
    EXPECT_EQ(depth_at(image, 5000, -1, 5), 0);
    EXPECT_EQ(depth_at(image, 5000, 640, 5), 0);
  }
  EXPECT_EQ(depth_at({}, 5000, 3, 3), 0);
}

TEST(FrameFeatures, ASlantedSurfaceIsASurfaceInAWideImageToo) {
  Camera camera;
  camera.fx = camera.fy = 100;
  // A floor 1.4 m below, at 30 degrees to the rays in the middle of its part of the image.
  cv::Mat floor(480, 640, CV_32FC1, cv::Scalar(0));
  for (int y = 260; y < 480; ++y) floor.row(y) = 1.4 * camera.fy / (y - camera.cy);
  cv::Mat step = floor.clone();
  step.colRange(320, 640) *= 1.2;  // what stands before something else is none
  Features features;
  features.keypoints.resize(1);
  features.keypoints[0].x = 318, features.keypoints[0].y = 350;
  features.descriptors.resize(1);
  EXPECT_GT(FrameFeatures(camera, features, floor, 1.2, 1, nullptr).depth(0), 0);
  EXPECT_EQ(FrameFeatures(camera, features, step, 1.2, 1, nullptr).depth(0), 0);
  camera.fx = camera.fy = 525;
  EXPECT_EQ(FrameFeatures(camera, features, floor, 1.2, 1, nullptr).depth(0), 0);
}

TEST(FrameFeatures, DropsWhatAFisheyeSeesBesideTheCamera) {
  Camera camera;
  camera.lens = LensModel::equidistant;
  camera.fx = camera.fy = 200;  // the corners are 115 degrees off the axis
  Features features = random_features(800, 1);
  const FrameFeatures frame(camera, features, {}, 1.2, 6, nullptr);
  EXPECT_LT(frame.size(), 800);
  EXPECT_GT(frame.size(), 500);
  for (int i = 0; i < frame.size(); ++i) EXPECT_TRUE(frame.pixel(i).allFinite());
}

TEST(FrameFeatures, EmptyFrameIsFine) {
  const FrameFeatures frame(Camera(), {}, {}, 1.2, 6, nullptr);
  EXPECT_EQ(frame.size(), 0);
  frame.for_each_in_window(10, 10, 1000, 0, 9, [](int) { FAIL(); });
}

TEST(FrameFeatures, ComesBackFromWhatIsStored) {
  Camera camera;
  camera.k1 = 0.2;
  const cv::Mat depth(480, 640, CV_16UC1, cv::Scalar(9000));
  const FrameFeatures frame(camera, random_features(300, 4), depth, 1.3, 5, nullptr);
  const FrameFeatures again(camera, {frame.keypoints(), frame.descriptors(), frame.pixels(), frame.depths(),
                                     frame.patches(), frame.scale_factor(), frame.levels()});
  ASSERT_EQ(again.size(), frame.size());
  EXPECT_EQ(again.usual_depth(), frame.usual_depth());
  EXPECT_EQ(again.levels(), 5);
  EXPECT_EQ(again.scale(4), frame.scale(4));
  EXPECT_EQ(again.log_scale_factor(), frame.log_scale_factor());
  EXPECT_EQ(again.patch(0), nullptr);
  std::vector<int> found, found_again;
  frame.for_each_in_window(300, 200, 80, 0, 4, [&](int i) { found.push_back(i); });
  again.for_each_in_window(300, 200, 80, 0, 4, [&](int i) { found_again.push_back(i); });
  EXPECT_FALSE(found.empty());
  EXPECT_EQ(found, found_again);
}

}  // namespace
}  // namespace stdc
