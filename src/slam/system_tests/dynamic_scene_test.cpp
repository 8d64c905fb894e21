// The whole system on a scene in which something large moves.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "core/random.hpp"
#include "slam/system_tests/test_sequence.hpp"

namespace stdc {
namespace {

using test::same_bytes;
using test::TestSequence;

constexpr int kFrames = 60;

/// A textured board, 0.7 m before the camera, that follows its view for a while and then slides out of it:
/// what misleads a system that believes all to be static.
struct Intruder {
  static cv::Rect place(int frame) { return {110 + (frame < 30 ? frame : 60 - frame) * 3, 40, 110, 200}; }

  Intruder() : texture(200, 110, CV_8UC3) {
    Random random(3);
    for (int y = 0; y < texture.rows; ++y) {
      for (int x = 0; x < texture.cols; ++x) {
        for (int c = 0; c < 3; ++c) {
          texture.at<cv::Vec3b>(y, x)[c] = static_cast<std::uint8_t>(random.below(256));
        }
      }
    }
    cv::GaussianBlur(texture, texture, {}, 1.3);
  }
  RgbdImage with_it(const RgbdImage& image, int frame) const {
    RgbdImage changed{image.timestamp, image.colour.clone(), image.depth.clone()};
    texture.copyTo(changed.colour(place(frame)));
    changed.depth(place(frame)).setTo(0.7 * TestSequence::of_a_desk().camera.depth_units_per_metre);
    return changed;
  }
  cv::Mat texture;
};

/// Knows where the board is, all but a strip at its sides.
class BoardSegmenter : public Segmenter {
 public:
  explicit BoardSegmenter(int pause_ms) : pause_ms_(pause_ms) {}
  cv::Mat segment(const SegmenterInput& input) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(pause_ms_));
    cv::Mat mask = cv::Mat::zeros(input.colour.size(), CV_8UC1);
    cv::Rect place = Intruder::place(input.frame);
    place.x += 5, place.width -= 10;
    mask(place) = 255;
    return mask;
  }

 private:
  int pause_ms_;
};

struct Result {
  std::vector<FramePose> trajectory;
  double worst_error = 0;  ///< distance from the truth [m]
  int on_board = 0;        ///< keypoints on the board, over all frames
  int ok = 0;
};

Result run_dynamic(const Settings& settings, std::unique_ptr<Segmenter> segmenter) {
  const TestSequence& sequence = TestSequence::of_a_desk();
  const Intruder intruder;
  Slam slam(sequence.camera, settings, std::move(segmenter));
  Result result;
  for (int i = 0; i < kFrames; ++i) {
    const TrackingResult tracked = slam.track(intruder.with_it(sequence.frames[i].image, i));
    result.ok += tracked.status == TrackingStatus::ok ? 1 : 0;
    const cv::Rect board = Intruder::place(i);
    result.on_board += static_cast<int>(
        std::count_if(tracked.keypoints.begin(), tracked.keypoints.end(), [&](const Keypoint& keypoint) {
          return board.contains(cv::Point(cvRound(keypoint.x), cvRound(keypoint.y)));
        }));
  }
  result.trajectory = slam.trajectory();
  const Pose first_from_truth = sequence.frames[0].world_from_cam.inverse();
  for (const FramePose& pose : result.trajectory) {
    const Pose truth = first_from_truth * sequence.frames[pose.frame].world_from_cam;
    result.worst_error =
        std::max(result.worst_error, (truth.translation - pose.world_from_cam.translation).norm());
  }
  return result;
}

Settings dynamic_settings(SegmentationPace pace) {
  Settings settings;
  settings.features.keypoints = 500;
  settings.segmentation.pace = pace;
  settings.system.report_keypoints = true;
  return settings;
}

TEST(DynamicScene, NoKeypointLiesOnWhatMoves) {
  const Result result =
      run_dynamic(dynamic_settings(SegmentationPace::every_frame), std::make_unique<BoardSegmenter>(0));
  EXPECT_EQ(result.on_board, 0) << "the strips at the sides are refined away too";
  EXPECT_EQ(result.ok, kFrames);
  EXPECT_LT(result.worst_error, 0.02);
}

TEST(DynamicScene, MasksMakeTheDifference) {
  const Settings settings = dynamic_settings(SegmentationPace::every_frame);
  const double with = run_dynamic(settings, std::make_unique<BoardSegmenter>(0)).worst_error;
  const double without = run_dynamic(settings, nullptr).worst_error;
  EXPECT_LT(3 * with, without);
}

TEST(DynamicScene, LateMasksKeepTheirWorth) {
  const Result result =
      run_dynamic(dynamic_settings(SegmentationPace::asynchronous), std::make_unique<BoardSegmenter>(0));
  EXPECT_EQ(result.ok, kFrames);
  EXPECT_LT(result.worst_error, 0.02);
}

TEST(DynamicScene, ThePaceOfTheSegmenterChangesNoByte) {
  for (const auto pace : {SegmentationPace::every_frame, SegmentationPace::asynchronous}) {
    const Settings settings = dynamic_settings(pace);
    EXPECT_TRUE(same_bytes(run_dynamic(settings, std::make_unique<BoardSegmenter>(0)).trajectory,
                           run_dynamic(settings, std::make_unique<BoardSegmenter>(12)).trajectory));
  }
}

}  // namespace
}  // namespace stdc
