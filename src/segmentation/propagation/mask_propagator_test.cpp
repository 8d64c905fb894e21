#include "segmentation/propagation/mask_propagator.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/files/test_folder.hpp"
#include "segmentation/propagation/test_stage.hpp"

namespace stdc {
namespace {

using test::kBodyDepth;
using test::kUnits;
using test::kWallDepth;
using test::message_of;
using test::Shot;
using test::Stage;

double overlap(const cv::Mat& a, const cv::Mat& b) {
  const int all = cv::countNonZero(a | b);
  return all == 0 ? 1 : static_cast<double>(cv::countNonZero(a & b)) / all;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_L1) == 0;
}

TEST(MaskPropagator, FollowsABody) {
  const Stage stage;
  MaskPropagator propagator{Camera()};
  for (int i = 0; i <= 8; ++i) {
    const Shot shot = stage.shoot({60 + 17 * i, 100 + 9 * i});
    propagator.add_frame(i, shot.grey, shot.depth);
    if (i == 0) propagator.set_mask(0, shot.mask);
    EXPECT_EQ(propagator.age(), i);
    EXPECT_GT(overlap(propagator.mask(), shot.mask), i == 0 ? 0.9999 : 0.97) << i;
  }
}

TEST(MaskPropagator, FollowsTwoBodiesThatPassEachOther) {
  const Stage stage;
  MaskPropagator propagator{Camera()};
  for (int i = 0; i <= 8; ++i) {
    Shot shot = stage.shoot({300 - 14 * i, 160}, {120, 300}, 2.2);
    const Shot front = stage.shoot({150 + 12 * i, 90});
    front.grey.copyTo(shot.grey, front.mask);
    front.depth.copyTo(shot.depth, front.mask);
    shot.mask |= front.mask;
    propagator.add_frame(i, shot.grey, shot.depth);
    if (i == 0) propagator.set_mask(0, shot.mask);
    // Later the far one comes out again at the other side of the near one.
    EXPECT_GT(overlap(propagator.mask(), shot.mask), i <= 6 ? 0.93 : 0.85) << i;
  }
}

TEST(MaskPropagator, BringsALateMaskToTheNewestFrame) {
  const Stage stage;
  MaskPropagator early{Camera()}, late{Camera()};
  Shot shot;
  cv::Mat mask;
  for (int i = 0; i <= 5; ++i) {
    shot = stage.shoot({60 + 17 * i, 100});
    early.add_frame(i, shot.grey, shot.depth);
    late.add_frame(i, shot.grey, shot.depth);
    if (i == 2) mask = shot.mask;
    if (i == 2) early.set_mask(2, mask);
  }
  EXPECT_FALSE(late.has_mask());
  EXPECT_TRUE(late.mask().empty());
  EXPECT_TRUE(late.set_mask(2, mask));
  EXPECT_EQ(late.age(), 3);
  EXPECT_GT(overlap(late.mask(), shot.mask), 0.97);
  EXPECT_TRUE(same(late.mask(), early.mask()));  // whenever it comes
}

TEST(MaskPropagator, TheLaterMaskCounts) {
  const Stage stage;
  MaskPropagator propagator{Camera(), {.history = 4}};
  Shot shot;
  for (int i = 0; i <= 6; ++i) {
    shot = stage.shoot({60 + 10 * i, 100});
    propagator.add_frame(10 + i, shot.grey, shot.depth);
    if (i == 0) propagator.set_mask(10, shot.mask);
  }
  EXPECT_GT(overlap(propagator.mask(), shot.mask), 0.96);  // carried further than frames are kept
  EXPECT_FALSE(propagator.set_mask(12, shot.mask));        // forgotten
  EXPECT_FALSE(propagator.set_mask(17, shot.mask));        // not there yet
  EXPECT_EQ(propagator.age(), 6);
  EXPECT_TRUE(propagator.set_mask(15, cv::Mat::zeros(480, 640, CV_8UC1)));
  EXPECT_EQ(propagator.age(), 1);
  EXPECT_EQ(cv::countNonZero(propagator.mask()), 0);
  EXPECT_FALSE(propagator.set_mask(14, shot.mask));  // of an earlier frame than the one it has
}

TEST(MaskPropagator, ABodyThatComesInThroughTheEdgeIsContinued) {
  const Stage stage;
  MaskPropagator propagator{Camera()};
  for (int i = 0; i <= 5; ++i) {
    const Shot shot = stage.shoot({-90 + 12 * i, 120}, {200, 260});
    propagator.add_frame(i, shot.grey, shot.depth);
    if (i == 0) propagator.set_mask(0, shot.mask);
    EXPECT_GT(overlap(propagator.mask(), shot.mask), 0.95) << i;
  }
}

TEST(MaskPropagator, WhereNothingCanBeFollowedTheCameraDecides) {
  // A body without texture before a wall without any, and a camera that moves sideways.
  const Camera camera;
  MaskPropagator propagator(camera);
  cv::Mat truth;
  for (int i = 0; i <= 4; ++i) {
    const int shift = 14 * i;  // of the body; 1.6 m away
    cv::Mat grey(480, 640, CV_8UC1, cv::Scalar(120)),
        depth(480, 640, CV_16UC1, cv::Scalar(kWallDepth * kUnits));
    truth = cv::Mat::zeros(480, 640, CV_8UC1);
    const cv::Rect body(200 + shift, 100, 150, 260);
    depth(body) = cv::Scalar(kBodyDepth * kUnits);
    truth(body) = 255;
    Pose motion;
    motion.translation.x() = 14 / camera.fx * kBodyDepth;
    propagator.add_frame(i, grey, depth, motion);
    if (i == 0) propagator.set_mask(0, truth);
  }
  EXPECT_GT(overlap(propagator.mask(), truth), 0.95);
}

TEST(MaskPropagator, DropsWhatIsNotAtTheBodysDepth) {
  // The mask covers a good deal of the wall beside the body; in the next frame that has gone.
  const Stage stage;
  const Shot shot = stage.shoot({200, 100});
  cv::Mat wide;
  cv::dilate(shot.mask, wide, cv::getStructuringElement(cv::MORPH_RECT, {11, 11}));
  MaskPropagator propagator{Camera()};
  propagator.add_frame(0, shot.grey, shot.depth);
  propagator.set_mask(0, wide);
  const Shot next = stage.shoot({210, 100});
  propagator.add_frame(1, next.grey, next.depth);
  EXPECT_LT(overlap(wide, shot.mask), 0.92);
  EXPECT_GT(overlap(propagator.mask(), next.mask), 0.96);
}

TEST(MaskPropagator, KeepsPixelsWithoutDepth) {
  const Stage stage;
  MaskPropagator propagator{Camera()};
  for (int i = 0; i <= 2; ++i) {
    Shot shot = stage.shoot({200 + 8 * i, 100});
    shot.depth(cv::Rect(230 + 8 * i, 150, 60, 60)) = 0;
    propagator.add_frame(i, shot.grey, shot.depth);
    if (i == 0) propagator.set_mask(0, shot.mask);
    EXPECT_GT(overlap(propagator.mask(), shot.mask), 0.97) << i;
  }
}

TEST(MaskPropagator, TakesDepthInMetresAndOtherSizes) {
  for (const cv::Size size : {cv::Size(640, 480), {320, 240}, {848, 480}, {333, 251}}) {
    const Stage stage(size);
    Camera camera;
    camera.width = size.width;
    camera.height = size.height;
    MaskPropagator in_units(camera), in_metres(camera);
    const cv::Size body(size.width / 4, size.height / 2);
    for (int i = 0; i <= 3; ++i) {
      const Shot shot = stage.shoot({size.width / 8 + i * size.width / 60, size.height / 4}, body);
      cv::Mat metres;
      shot.depth.convertTo(metres, CV_32F, 1 / kUnits);
      in_units.add_frame(i, shot.grey, shot.depth);
      in_metres.add_frame(i, shot.grey, metres);
      if (i == 0) in_units.set_mask(0, shot.mask);
      if (i == 0) in_metres.set_mask(0, shot.mask);
      EXPECT_GT(overlap(in_units.mask(), shot.mask), 0.94) << size << i;
      EXPECT_GT(overlap(in_metres.mask(), in_units.mask()), 0.999) << size << i;
    }
  }
}

TEST(MaskPropagator, SameFramesSameBytes) {
  const Stage stage;
  cv::Mat masks[2];
  for (cv::Mat& mask : masks) {
    MaskPropagator propagator{Camera()};
    for (int i = 0; i <= 4; ++i) {
      const Shot shot = stage.shoot({80 + 15 * i, 110 - 6 * i});
      propagator.add_frame(i, shot.grey, shot.depth);
      if (i == 0) propagator.set_mask(0, shot.mask);
    }
    mask = propagator.mask();
  }
  EXPECT_TRUE(same(masks[0], masks[1]));
}

TEST(MaskPropagator, ForgetsABodyThatHasLeft) {
  const Stage stage;
  MaskPropagator propagator{Camera()};
  for (int i = 0; i <= 9; ++i) {
    const Shot shot = stage.shoot({500 + 20 * i, 120});
    propagator.add_frame(i, shot.grey, shot.depth);
    if (i == 0) propagator.set_mask(0, shot.mask);
  }
  EXPECT_LT(cv::countNonZero(propagator.mask()), 200);
}

TEST(MaskPropagator, RefusesWhatDoesNotFit) {
  const cv::Mat grey(480, 640, CV_8UC1, cv::Scalar(0)), depth(480, 640, CV_16UC1, cv::Scalar(0));
  MaskPropagator propagator{Camera()};
  EXPECT_NE(message_of([&] { propagator.add_frame(0, depth, depth); }).find("grey"), std::string::npos);
  EXPECT_NE(message_of([&] { propagator.add_frame(0, grey, grey); }).find("depth"), std::string::npos);
  EXPECT_NE(message_of([&] { propagator.add_frame(0, grey.rowRange(0, 9), depth); }), "");
  propagator.add_frame(3, grey, depth);
  EXPECT_NE(message_of([&] { propagator.add_frame(3, grey, depth); }).find("does not follow"),
            std::string::npos);
  EXPECT_NE(message_of([&] { propagator.set_mask(3, depth); }).find("mask"), std::string::npos);
  EXPECT_NE(message_of([] { MaskPropagator(Camera(), {.history = 1}); }).find("propagation.history"),
            std::string::npos);
}

}  // namespace
}  // namespace stdc
