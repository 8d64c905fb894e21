#include "report/pictures/debug_images.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "run/test_sequence.hpp"

namespace stdc::app {
namespace {

using stdc::test::TestFolder;

TEST(DrawKeypoints, MarksEveryKeypoint) {
  const cv::Mat grey(120, 160, CV_8UC1, cv::Scalar(100));
  TrackingResult result;
  const cv::Mat plain = draw_keypoints(grey, 0, result);
  EXPECT_EQ(plain.cols, 320);
  for (const KeypointState state :
       {KeypointState::inlier, KeypointState::outlier, KeypointState::unmatched}) {
    Keypoint keypoint;
    keypoint.x = 20 + 40 * static_cast<float>(result.keypoints.size());
    keypoint.y = 60;
    keypoint.quality = KeypointQuality::high;
    result.keypoints.push_back(keypoint);
    result.keypoint_states.push_back(state);
    const cv::Vec3b before = plain.at<cv::Vec3b>(120, cvRound(2 * keypoint.x));
    EXPECT_NE(draw_keypoints(grey, 0, result).at<cv::Vec3b>(120, cvRound(2 * keypoint.x)), before);
  }
}

TEST(DebugImages, WritesEveryNthAndTheLost) {
  const TestFolder folder;
  RgbdImage image;
  image.colour = stdc::test::test_texture(240);
  DebugImages images(folder / "p", 4, FeatureSettings());
  for (int i = 0; i < 8; ++i) {
    TrackingResult result;
    result.frame = i;
    result.status = i == 6 ? TrackingStatus::lost : TrackingStatus::ok;
    images.on_frame({100 + i, &image, result});
  }
  images.commit();
  for (const char* name : {"keypoints_000100.png", "cells_000104.png", "keypoints_000106.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "p" / name)) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "p/keypoints_000101.png"));
}

}  // namespace
}  // namespace stdc::app
