#include "report/debug_images.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "run/test_sequence.hpp"

namespace stdc::app {
namespace {

using stdc::test::TestFolder;

/// Number of pixels that have another colour than the plain picture.
int changed(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference, grey;
  cv::absdiff(a, b, difference);
  cv::cvtColor(difference, grey, cv::COLOR_BGR2GRAY);
  return cv::countNonZero(grey);
}

Trajectory line(int count, double slope) {
  Trajectory path;
  for (int i = 0; i < count; ++i) {
    path.push_back({i / 30.0, Pose(Eigen::Quaterniond::Identity(), {0.01 * i, slope * i, 0.02 * i})});
  }
  return path;
}

TEST(DrawTopView, DrawsWhatThereIs) {
  const cv::Mat empty = draw_top_view({});
  EXPECT_EQ(empty.size(), cv::Size(1600, 1200));
  EXPECT_EQ(empty.type(), CV_8UC3);
  TopView view;
  view.estimate = line(50, 0);
  EXPECT_GT(changed(draw_top_view(view), empty), 1000);
  view.landmarks = {{0.1, 0, 0.5}, {1e12, 0, -1e12}, {0, 0, 0.3}};
  view.keyframes = {view.estimate[3], view.estimate[30]};
  view.truth = line(60, 0.0001);
  view.truth_from_estimate = Pose();
  EXPECT_GT(changed(draw_top_view(view), empty), 1000);
}

TEST(DrawTopView, TakesOddTrajectories) {
  TopView view;
  view.estimate = line(1, 0);
  EXPECT_FALSE(draw_top_view(view).empty());
  view.estimate = {{0, Pose()}, {10, Pose()}};  // stands still, with a gap
  view.truth = {{100, Pose()}};                 // another time
  view.truth_from_estimate = Pose();
  EXPECT_FALSE(draw_top_view(view).empty());
}

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
  images.add_top_view({});
  images.commit();
  for (const char* name :
       {"keypoints_000100.png", "cells_000104.png", "keypoints_000106.png", "top_view.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "p" / name)) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "p/keypoints_000101.png"));
}

}  // namespace
}  // namespace stdc::app
