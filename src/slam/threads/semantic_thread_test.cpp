#include "slam/threads/semantic_thread.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/random.hpp"

namespace stdc {
namespace {

constexpr int kWidth = 160, kHeight = 120;

Camera camera() {
  Camera camera;
  camera.width = kWidth, camera.height = kHeight;
  camera.fx = camera.fy = 150, camera.cx = 79.5, camera.cy = 59.5;
  return camera;
}

/// A textured wall at 3 m with a box at 1 m before it, which moves by 2 pixels a frame.
struct BoxBeforeWall {
  static cv::Rect box(int frame) { return {20 + 2 * frame, 30, 40, 60}; }

  static RgbdImage image(int frame) {
    Random random(7);
    RgbdImage image{frame / 30.0, cv::Mat(kHeight, kWidth, CV_8UC1), cv::Mat(kHeight, kWidth, CV_16UC1)};
    image.depth.setTo(3 * 5000);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x)
        image.colour.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(random.below(60));
    }
    cv::GaussianBlur(image.colour, image.colour, {}, 1.5);
    cv::Mat texture(60, 40, CV_8UC1);
    for (int y = 0; y < texture.rows; ++y) {
      for (int x = 0; x < texture.cols; ++x) {
        texture.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(100 + random.below(156));
      }
    }
    cv::GaussianBlur(texture, texture, {}, 1.5);
    texture.copyTo(image.colour(box(frame)));
    image.depth(box(frame)).setTo(1 * 5000);
    return image;
  }
  static cv::Mat truth(int frame) {
    cv::Mat mask = cv::Mat::zeros(kHeight, kWidth, CV_8UC1);
    mask(box(frame)) = 255;
    return mask;
  }
};

/// Gives the truth, or what `change` makes of it, after a while.
class FakeSegmenter : public Segmenter {
 public:
  using Change = std::function<cv::Mat(int frame, cv::Mat mask)>;
  explicit FakeSegmenter(Change change, int milliseconds = 0)
      : change_(std::move(change)), pause_(milliseconds) {}
  cv::Mat segment(const SegmenterInput& input) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(pause_));
    return change_(input.frame, BoxBeforeWall::truth(input.frame));
  }

 private:
  Change change_;
  int pause_;
};

cv::Mat same(int, cv::Mat mask) { return mask; }

std::vector<DynamicMask> run_masks(const SegmentationSettings& settings, int frames,
                                   FakeSegmenter::Change change = same, int milliseconds = 0) {
  SemanticThread thread(camera(), settings, {}, {}, std::make_unique<FakeSegmenter>(change, milliseconds));
  std::vector<DynamicMask> masks;
  for (int frame = 0; frame < frames; ++frame) {
    const RgbdImage image = BoxBeforeWall::image(frame);
    thread.begin(image, image.colour, frame);
    masks.push_back(thread.finish());
    masks.back().mask = masks.back().mask.clone();
  }
  return masks;
}

double overlap(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<double>(cv::countNonZero(a & b)) / cv::countNonZero(a | b);
}

TEST(SemanticThread, EveryFrameGetsItsOwnMask) {
  const auto masks = run_masks({.pace = SegmentationPace::every_frame}, 4);
  for (int frame = 0; frame < 4; ++frame) {
    const DynamicMask& mask = masks[static_cast<std::size_t>(frame)];
    EXPECT_EQ(mask.report.mask_age, 0);
    EXPECT_TRUE(mask.report.segmentation_ms);
    EXPECT_EQ(cv::countNonZero(mask.mask != BoxBeforeWall::truth(frame)), 0);
    EXPECT_NEAR(mask.report.dynamic_share, 40.0 * 60 / (kWidth * kHeight), 1e-9);
  }
}

TEST(SemanticThread, RefinesWhatTheSegmenterMissed) {
  const auto halved = [](int frame, cv::Mat mask) {
    const cv::Rect box = BoxBeforeWall::box(frame);
    mask(cv::Rect(box.x, box.y, 6, box.height)) = 0;
    return mask;
  };
  const auto refined = run_masks({.pace = SegmentationPace::every_frame}, 1, halved);
  EXPECT_EQ(cv::countNonZero(refined[0].mask != BoxBeforeWall::truth(0)), 0);
  const auto raw = run_masks({.pace = SegmentationPace::every_frame, .refinement = false}, 1, halved);
  EXPECT_EQ(cv::countNonZero(raw[0].mask), 34 * 60);
}

TEST(SemanticThread, AMissingMaskIsCarriedFromTheFrameBefore) {
  const auto gaps = [](int frame, cv::Mat mask) { return frame % 3 == 1 ? cv::Mat() : mask; };
  const auto masks = run_masks({.pace = SegmentationPace::every_frame}, 6, gaps);
  for (int frame = 0; frame < 6; ++frame) {
    const DynamicMask& mask = masks[static_cast<std::size_t>(frame)];
    EXPECT_EQ(mask.report.mask_age, frame % 3 == 1 ? 1 : 0);
    EXPECT_GT(overlap(mask.mask, BoxBeforeWall::truth(frame)), 0.8) << frame;
  }
}

TEST(SemanticThread, AsynchronousMasksHaveTheAgesThatFrameCountsSay) {
  const auto masks = run_masks({.pace = SegmentationPace::asynchronous, .latency = 3}, 11);
  const std::vector<int> ages{0, 1, 2, 3, 3, 4, 5, 3, 4, 5, 3};
  for (std::size_t i = 0; i < ages.size(); ++i) {
    EXPECT_EQ(masks[i].report.mask_age, ages[i]) << i;
    EXPECT_GT(overlap(masks[i].mask, BoxBeforeWall::truth(static_cast<int>(i))), 0.75) << i;
  }
}

TEST(SemanticThread, SlownessChangesNothing) {
  const SegmentationSettings settings{.pace = SegmentationPace::asynchronous, .latency = 2};
  const auto fast = run_masks(settings, 8), slow = run_masks(settings, 8, same, 15);
  for (std::size_t i = 0; i < fast.size(); ++i) {
    EXPECT_EQ(fast[i].report.mask_age, slow[i].report.mask_age);
    EXPECT_EQ(cv::countNonZero(fast[i].mask != slow[i].mask), 0) << i;
  }
}

TEST(SemanticThread, AFaultIsReportedAndSurvived) {
  const auto fault = [](int frame, cv::Mat mask) -> cv::Mat {
    if (frame == 2) throw Error("mask.png", "it is truncated", "make it again");
    return mask;
  };
  const auto masks = run_masks({.pace = SegmentationPace::every_frame}, 4, fault);
  EXPECT_EQ(masks[2].report.mask_age, 1);
  EXPECT_NE(masks[2].report.problem.find("mask.png"), std::string::npos);
  EXPECT_FALSE(masks[2].mask.empty());
  EXPECT_EQ(masks[3].report.mask_age, 0);
  EXPECT_TRUE(masks[3].report.problem.empty());
}

TEST(SemanticThread, WithoutAnyMaskNothingIsDynamic) {
  const auto none = [](int, cv::Mat) { return cv::Mat(); };
  for (const auto pace : {SegmentationPace::every_frame, SegmentationPace::asynchronous}) {
    for (const DynamicMask& mask : run_masks({.pace = pace}, 5, none)) {
      EXPECT_EQ(mask.report.mask_age, -1);
      EXPECT_TRUE(mask.mask.empty());
    }
  }
}

TEST(SemanticThread, ADepthImageMayBeMissing) {
  for (const auto pace : {SegmentationPace::every_frame, SegmentationPace::asynchronous}) {
    SemanticThread thread(camera(), {.pace = pace}, {}, {}, std::make_unique<FakeSegmenter>(same));
    for (int frame = 0; frame < 6; ++frame) {
      RgbdImage image = BoxBeforeWall::image(frame);
      if (frame > 1) image.depth.release();
      thread.begin(image, image.colour, frame);
      EXPECT_GT(thread.finish().report.dynamic_share, 0) << frame;
    }
  }
}

/// In which of the frames the segmenter looked, for a person who comes at frame `first`.
std::vector<int> frames_segmented(const SegmentationSettings& settings, int frames, int first,
                                  std::vector<DynamicMask>* masks = nullptr) {
  std::vector<int> seen;
  const auto found = run_masks(settings, frames, [&](int frame, cv::Mat mask) {
    seen.push_back(frame);
    if (frame < first) mask = 0;
    return mask;
  });
  if (masks != nullptr) *masks = found;
  return seen;
}

TEST(SemanticThread, RestsWhileNobodyIsSeen) {
  SegmentationSettings settings;
  settings.idle_after = 0.5, settings.refinement = false;
  std::vector<DynamicMask> masks;
  const std::vector<int> seen = frames_segmented(settings, 30, 20, &masks);
  // All of the first half second, one in three, and all from the one in which the person is found.
  std::vector<int> expected;
  for (int frame = 0; frame < 15; ++frame) expected.push_back(frame);
  for (const int frame : {17, 20}) expected.push_back(frame);
  for (int frame = 21; frame < 30; ++frame) expected.push_back(frame);
  EXPECT_EQ(seen, expected);
  EXPECT_EQ(masks[16].report.mask_age, 2);
  EXPECT_EQ(cv::countNonZero(masks[16].mask), 0);
  EXPECT_EQ(masks[20].report.mask_age, 0);
  // A newcomer waits for at most as long as it is set.
  const std::vector<int> late = frames_segmented(settings, 30, 18, &masks);
  EXPECT_GT(cv::countNonZero(masks[20].mask), 0);
  settings.idle_interval = 0;
  EXPECT_EQ(frames_segmented(settings, 30, 20).size(), 30U);
}

TEST(SemanticThread, DoesNotRestWithMasksFromFilesOrSlowCameras) {
  SegmentationSettings settings;
  settings.idle_after = 0.5;
  settings.source = SegmentationSource::masks;
  EXPECT_EQ(frames_segmented(settings, 30, 30).size(), 30U);
  settings.source = SegmentationSource::network;
  settings.idle_interval = 0.05;  // the frame after the next would be too late
  EXPECT_EQ(frames_segmented(settings, 30, 30).size(), 30U);
}

}  // namespace
}  // namespace stdc
