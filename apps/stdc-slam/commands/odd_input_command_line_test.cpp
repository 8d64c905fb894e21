// Inputs as users have them: hand-made stamps, masks of another sequence, truths in other conventions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "atlas/storage/map_file.hpp"
#include "commands/test_command_line.hpp"
#include "input/trajectory.hpp"

namespace stdc::app {
namespace {

class OddInput : public CommandLine {};

TEST_F(OddInput, ARateReplacesStampsMadeByHand) {
  make_sequence(6);
  std::string rgb, depth;
  for (int i = 0; i < 6; ++i) {
    rgb += fmt::format("0.033 rgb/{}.png\n", i);
    depth += fmt::format("0.033 depth/{}.png\n", i);
  }
  folder_.write("s/rgb.txt", rgb);
  folder_.write("s/depth.txt", depth);
  expect_refusal("run s --output o --segmentation off", "--rate HZ");
  ASSERT_EQ(call("run s --output o --segmentation off --rate 10 --quiet").code, 0);
  EXPECT_TRUE(contains(content(folder_ / "o/trajectory.txt"), "\n0.500000 "));
}

TEST_F(OddInput, MasksThatBelongToNoImageAreRefused) {
  make_sequence(3);
  folder_.write("masks/5.000000.png", encode_png(cv::Mat(240, 320, CV_8UC1, cv::Scalar(0))));
  expect_refusal("run s --output o --masks masks",
                 "masks: none of its 1 masks has the name, time or number of an image");
}

TEST_F(OddInput, AnEmptyMapIsNothingToBeLocatedIn) {
  make_sequence(3);
  save_map(folder_ / "empty.map", stdc::test::test_camera(), Atlas());
  expect_refusal("run s --output o --segmentation off --load-map empty.map --localisation-only",
                 "empty.map: holds an empty map");
}

TEST_F(OddInput, NanosecondsAreRecognisedAndSaid) {
  make_sequence(12);
  Trajectory truth = read_trajectory(folder_ / "s/groundtruth.txt");
  std::string text;
  for (const StampedPose& pose : truth) {
    const Eigen::Vector3d& t = pose.world_from_cam.translation;
    const Eigen::Quaterniond& q = pose.world_from_cam.rotation;
    text += fmt::format("{:.0f} {} {} {} {} {} {} {}\n", 1e9 * pose.timestamp, t.x(), t.y(), t.z(), q.x(),
                        q.y(), q.z(), q.w());
  }
  folder_.write("s/groundtruth.txt", text);
  const Outcome outcome = call("run s --output o --segmentation off --quiet");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.err, "its times are taken for nanoseconds")) << outcome.err;
  const auto summary = nlohmann::json::parse(content(folder_ / "o/summary.json"));
  EXPECT_EQ(summary["scores"]["pairs"], 12);
  EXPECT_EQ(summary["groundtruth"]["convention"], "its times are taken for nanoseconds");
}

}  // namespace
}  // namespace stdc::app
