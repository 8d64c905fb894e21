#include "commands/test_command_line.hpp"

namespace stdc::app {
namespace {

class ConvertMcapCommandLine : public CommandLine {
 protected:
  std::string trajectory(const std::string& input) const {
    fs::remove_all(folder_ / "o");
    const Outcome outcome = call("run " + input + " --output o --segmentation off --quiet --no-report");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return content(folder_ / "o/trajectory.txt");
  }
};

TEST_F(ConvertMcapCommandLine, TheRecordingGivesThePosesOfTheFolder) {
  make_sequence(20);
  const std::string expected = trajectory("s");
  EXPECT_GT(lines(expected), 10);
  const Outcome outcome = call("convert s --output s.mcap");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "20 frames, 20 true poses: s.mcap")) << outcome.out;
  EXPECT_EQ(trajectory("s.mcap"), expected);
  EXPECT_TRUE(contains(content(folder_ / "o/summary.json"), "\"rmse\"")) << "it has a ground truth";
  fs::remove_all(folder_ / "o");
  expect_refusal("convert s --output s.mcap --quiet", "s.mcap: is there already");
  EXPECT_EQ(call("convert s --output s.mcap --quiet --overwrite").code, 0);
}

TEST_F(ConvertMcapCommandLine, HoldsWhatCameraInfoHasNoPlaceFor) {
  make_sequence(20);
  const std::string all_at_once = trajectory("s");
  ASSERT_EQ(call("convert s --output plain.mcap --quiet").code, 0);
  EXPECT_FALSE(contains(call("info plain.mcap").out, "/stdc_slam/camera"));
  std::string camera = content(folder_ / "s/camera.yaml");
  const std::size_t at = camera.find("readout_time: ");
  ASSERT_NE(at, std::string::npos) << camera;
  camera.replace(at, camera.find('\n', at) - at, "readout_time: 0.02");
  folder_.write("s/camera.yaml", camera);
  const Outcome outcome = call("convert s --output s.mcap");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(call("info s.mcap").out, "/stdc_slam/camera"));
  const std::string expected = trajectory("s");
  EXPECT_NE(expected, all_at_once);
  EXPECT_EQ(trajectory("s.mcap"), expected);
}

TEST_F(ConvertMcapCommandLine, ShowsWhatARunMadeOfIt) {
  make_sequence(20);
  ASSERT_EQ(
      call("run s --output o --save-map m.map --save-masks masks --segmentation off --quiet --no-report")
          .code,
      0);
  const Outcome outcome = call("convert s --output s.mcap --results o --map m.map --masks masks --quiet");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string streams = call("info s.mcap").out;
  for (const char* topic :
       {"/tf", "/stdc_slam/path", "/stdc_slam/landmarks", "/stdc_slam/dynamic_mask/compressed"}) {
    EXPECT_TRUE(contains(streams, topic)) << topic << " is not in\n" << streams;
  }
  fs::remove_all(folder_ / "o");
  EXPECT_EQ(trajectory("s.mcap"), trajectory("s")) << "whatever else is in it";
  fs::remove_all(folder_ / "o");
  expect_refusal("convert s --output folder --results masks --quiet", "has no place for results of a run");
  expect_refusal("convert s --output t.mcap --results nowhere --quiet", "nowhere/trajectory.txt");
  EXPECT_FALSE(fs::exists(folder_ / "t.mcap"));
}

/// By Foxglove's packages, with all check sums, by the index and as a stream.
TEST_F(ConvertMcapCommandLine, SomebodyElsesReaderReadsIt) {
  make_sequence(20);
  ASSERT_EQ(
      call("run s --output o --save-map m.map --save-masks masks --segmentation off --quiet --no-report")
          .code,
      0);
  ASSERT_EQ(call("convert s --output s.mcap --results o --map m.map --masks masks --quiet").code, 0);
  const std::string command = fmt::format("cd {} && {} s.mcap > .read 2>&1", folder_.path().string(),
                                          STDC_SOURCE_FOLDER "/scripts/read_mcap");
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  const std::string found = content(folder_ / ".read");
  constexpr int kNotInstalled = 3;
  if (WEXITSTATUS(status) == kNotInstalled) GTEST_SKIP() << found;
  ASSERT_EQ(WEXITSTATUS(status), 0) << found;
  for (const char* line :
       {"/camera/color/image_raw/compressed sensor_msgs/msg/CompressedImage 20 ",
        "/camera/color/camera_info sensor_msgs/msg/CameraInfo 20 ",
        "/camera/aligned_depth_to_color/image_raw sensor_msgs/msg/Image 20 ",
        "/ground_truth/pose geometry_msgs/msg/PoseStamped 20 ", "/tf tf2_msgs/msg/TFMessage 20 ",
        "/stdc_slam/path nav_msgs/msg/Path 1 ", "/stdc_slam/landmarks sensor_msgs/msg/PointCloud2 1 ",
        "/stdc_slam/dynamic_mask/compressed sensor_msgs/msg/CompressedImage 20 ",
        "\"distortion_model\":\"plumb_bob\"", "messages in the stream: 142 statistics: 142"}) {
    EXPECT_TRUE(contains(found, line)) << line << " is not in\n" << found;
  }
}

}  // namespace
}  // namespace stdc::app
