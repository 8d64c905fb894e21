// stdc-slam ros2 against a peer in another process, built on another DDS library (Cyclone DDS) with message
// definitions that are not ours (Debian's): tools/ros2_peer. Over loopback only. Nothing here depends on how
// fast the machine is: where frames are counted the publisher waits for the subscriber.
#include <unistd.h>

#include <map>
#include <sstream>

#include "commands/test_command_line.hpp"
#include "input/trajectory.hpp"

namespace stdc::app {
namespace {

constexpr const char* kTopics =
    "ros2 --color /camera/color/image_raw --depth /camera/aligned_depth_to_color/image_raw --segmentation "
    "off "
    "--motion off";

class Ros2CommandLine : public CommandLine {
 protected:
  void SetUp() override {
#ifndef STDC_ROS2_PEER
    GTEST_SKIP() << "needs cyclonedds-dev, cyclonedds-tools and ros-*-msgs: scripts/packages-optional.txt";
#endif
  }

  /// Runs a script of the shell in the folder; $SLAM and $PEER are the programs.
  Outcome script(const std::string& text) const {
#ifdef STDC_ROS2_PEER
    const char* peer = STDC_ROS2_PEER;
#else
    const char* peer = "";
#endif
    // Nothing leaves the machine, and hardly another test is in the same domain.
    const std::string head = fmt::format(
        "export ROS_LOCALHOST_ONLY=1 ROS_DOMAIN_ID={} SLAM={} PEER={}\n"
        "export CYCLONEDDS_URI='<CycloneDDS><Domain><General><Interfaces><NetworkInterface "
        "address=\"127.0.0.1\"/></Interfaces><AllowMulticast>false</AllowMulticast></General><Discovery>"
        "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>20</"
        "MaxAutoParticipantIndex><Peers><Peer "
        "Address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>'\n",
        101 + getpid() % 99, STDC_PROGRAM, peer);
    folder_.write("script", head + text);
    const int status =
        std::system(fmt::format("cd {} && sh ./script > .out 2> .err", folder_.path().string()).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(folder_ / ".out"),
            content(folder_ / ".err")};
  }
};

/// "stamp parent child x y z qx qy qz qw" lines by stamp.
std::map<std::int64_t, Pose> transforms(const std::string& text, const std::string& wanted_child) {
  std::map<std::int64_t, Pose> result;
  std::istringstream lines(text);
  std::string parent, child;
  std::int64_t stamp = 0;
  Eigen::Vector3d t;
  Eigen::Vector4d q;
  while (lines >> stamp >> parent >> child >> t[0] >> t[1] >> t[2] >> q[0] >> q[1] >> q[2] >> q[3]) {
    if (child == wanted_child) result[stamp] = Pose(Eigen::Quaterniond(q[3], q[0], q[1], q[2]), t);
  }
  return result;
}

TEST_F(Ros2CommandLine, GivesThePosesOfTheFolderToTheByte) {
  make_sequence(21);
  ASSERT_EQ(call("run s --output o --frames :20 --segmentation off --motion off --quiet").code, 0);
  const Outcome outcome = script(
      fmt::format("$SLAM {} --camera s/camera.yaml --reception every-frame --frames :20 --output ros &\n"
                  "$PEER play s --lossless --await 20 --odometry odometry --tf tf || exit 9\nwait $!",
                  kTopics));
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(content(folder_ / "ros/trajectory.txt"), content(folder_ / "o/trajectory.txt"));
  EXPECT_EQ(content(folder_ / "ros/keyframes.txt"), content(folder_ / "o/keyframes.txt"));
  EXPECT_TRUE(contains(outcome.out, "20 frames, 20 with a pose, 0 dropped")) << outcome.out;

  const std::string odometry = content(folder_ / "odometry");
  EXPECT_EQ(lines(odometry), 20);
  EXPECT_TRUE(contains(odometry, " odom base_link\n"));
  EXPECT_TRUE(contains(odometry, "100633333000 ")) << "the stamp of the image, to the nanosecond";
  // Where the base is: the peer says that it stands 0.1 m behind and 0.2 m below the camera, which looks
  // forward and moves to its right: 1 cm a frame along the base's -y.
  const auto map_from_odom = transforms(content(folder_ / "tf"), "odom"),
             odom_from_base = transforms(content(folder_ / "tf"), "base_link");
  ASSERT_EQ(map_from_odom.size(), 20U);
  ASSERT_EQ(odom_from_base.size(), 20U);
  int i = 0;
  for (const auto& [stamp, pose] : odom_from_base) {
    const Eigen::Vector3d in_map = (map_from_odom.at(stamp) * pose).translation;
    EXPECT_LT((in_map - Eigen::Vector3d(0, -0.01 * i, 0)).norm(), 0.01) << i;
    ++i;
  }
}

TEST_F(Ros2CommandLine, ShowsItInABrowserWithoutAnotherByte) {
  make_sequence(21);
  ASSERT_EQ(call("run s --output o --frames :20 --segmentation off --motion off --quiet").code, 0);
  const Outcome outcome = script(fmt::format(
      "$SLAM {} --camera s/camera.yaml --reception every-frame --frames :20 --view 0 --output ros &\n"
      "$PEER play s --lossless --await 20 --odometry odometry --tf tf || exit 9\nwait $!",
      kTopics));
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "live view at http://localhost:")) << outcome.err;
  EXPECT_EQ(content(folder_ / "ros/trajectory.txt"), content(folder_ / "o/trajectory.txt"));
}

TEST_F(Ros2CommandLine, TakesTheCameraFromItsInfoAndDepthInMillimetres) {
  make_sequence(21);
  ASSERT_EQ(call("run s --output o --frames :20 --segmentation off --motion off --quiet").code, 0);
  const Outcome outcome =
      script(fmt::format("$SLAM {} --reception every-frame --frames :20 --output ros &\n"
                         "$PEER play s --lossless --millimetres --await 20 || exit 9\nwait $!",
                         kTopics));
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(content(folder_ / "ros/trajectory.txt"), content(folder_ / "o/trajectory.txt"));
}

TEST_F(Ros2CommandLine, RegistersDepthOfAnotherFrameByTfStatic) {
  make_sequence(21);
  const Outcome outcome = script(fmt::format(
      "$SLAM {} --depth /camera/depth/image_raw --reception every-frame --frames :20 --output ros &\n"
      "$PEER play s --lossless --raw-depth --millimetres --await 20 || exit 9\nwait $!",
      "ros2 --color /camera/color/image_raw --segmentation off --motion off"));
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(lines(content(folder_ / "ros/trajectory.txt")), 20);
  EXPECT_FALSE(contains(outcome.err, "taken as registered")) << outcome.err;
}

TEST_F(Ros2CommandLine, AnInterruptionWritesEverything) {
  make_sequence(16);
  const Outcome outcome = script(
      fmt::format("$SLAM {} --camera s/camera.yaml --reception every-frame --output ros --save-map m.map &\n"
                  "$PEER play s --lossless --await 15 || exit 9\nkill -INT $!\nwait $!",
                  kTopics));
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(lines(content(folder_ / "ros/trajectory.txt")), 16)
      << "also the frame that waited for a nearer depth";
  EXPECT_TRUE(fs::exists(folder_ / "m.map"));
  EXPECT_EQ(call("map info m.map").code, 0);
}

TEST_F(Ros2CommandLine, DoesWhatItIsAskedFor) {
  make_sequence(16);
  const Outcome outcome = script(fmt::format(
      "until_there() {{ i=0; while [ $i -lt 600 ] && ! grep -q \"$1\" log; do sleep 0.1; i=$((i+1)); done; "
      "}}\n"
      "$SLAM {} --camera s/camera.yaml --reception every-frame --save-map m.map 2> log & slam=$!\n"
      "$PEER play s --lossless --await 15 || exit 9\n"
      "$PEER send /stdc_slam/save_map; until_there save_map:; cp m.map first.map\n"
      "$PEER send /stdc_slam/start_localisation; until_there start_localisation:\n"
      "$PEER send /stdc_slam/save_map; until_there 'not while'\n"
      "$PEER play s --lossless --shift 100 --await 15 --odometry located || exit 8\n"
      "$PEER send /stdc_slam/start_mapping; until_there 'grows again'\n"
      "$PEER send /stdc_slam/reset; until_there 'begun anew'\n"
      "kill -INT $slam; wait $slam",
      kTopics));
  const std::string log = content(folder_ / "log");
  ASSERT_TRUE(outcome.code == 0) << outcome.code << outcome.out << log;
  EXPECT_TRUE(contains(log, "save_map: written to m.map")) << log;
  EXPECT_TRUE(contains(log, "start_localisation: the map stays as it is")) << log;
  EXPECT_TRUE(contains(log, "start_mapping: the map grows again")) << log;
  EXPECT_TRUE(contains(log, "reset: begun anew")) << log;
  EXPECT_TRUE(fs::exists(folder_ / "first.map"));
  EXPECT_GE(lines(content(folder_ / "located")), 15);
}

TEST_F(Ros2CommandLine, EitherSideMayDieAndComeBack) {
  make_sequence(16);
  const Outcome outcome =
      script(fmt::format("$SLAM {0} --camera s/camera.yaml --reception every-frame & first=$!\n"
                         "$PEER play s --lossless --await 10 > /dev/null || exit 9\n"
                         "kill -9 $first; wait $first\n"
                         "$SLAM {0} --camera s/camera.yaml --reception every-frame --output ros & second=$!\n"
                         "$PEER play s --lossless --loops 1000 > /dev/null & peer=$!\n"
                         "sleep 1; kill -9 $peer; wait $peer\n"
                         "$PEER play s --lossless --shift 5000 --await 15 --odometry after || exit 8\n"
                         "kill -INT $second; wait $second",
                         kTopics));
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_GE(lines(content(folder_ / "after")), 15);
}

TEST_F(Ros2CommandLine, SurvivesWhatNoCameraSends) {
  make_sequence(16);
  const Outcome outcome = script(
      fmt::format("$SLAM {} --camera s/camera.yaml --reception every-frame --output ros 2> log & slam=$!\n"
                  "$PEER evil /camera/color/image_raw wrong-type --seconds 60 & wrong=$!\n"
                  "i=0; while [ $i -lt 600 ] && ! grep -q 'is published as' log; do sleep 0.1; i=$((i+1)); "
                  "done; kill $wrong\n"
                  "$PEER evil /camera/color/image_raw lying-type --count 20\n"
                  "$PEER evil /camera/color/image_raw truncated --count 20 --rate 100\n"
                  "$PEER evil /camera/aligned_depth_to_color/image_raw flood --count 100 --rate 500\n"
                  "$PEER play s --lossless --await 14 --linger 2.5 --diagnostics diagnostics || exit 9\n"
                  "kill -INT $slam; wait $slam",
                  kTopics));
  const std::string log = content(folder_ / "log"), diagnostics = content(folder_ / "diagnostics");
  ASSERT_EQ(outcome.code, 0) << outcome.out << log;
  EXPECT_TRUE(contains(log, "/camera/color/image_raw is published as std_msgs/msg/Empty")) << log;
  EXPECT_TRUE(contains(diagnostics, "stdc_slam: tracking")) << diagnostics;
  EXPECT_TRUE(contains(diagnostics, "damaged messages=")) << diagnostics;
  EXPECT_FALSE(contains(diagnostics, "damaged messages=0;")) << diagnostics;
}

TEST_F(Ros2CommandLine, RecordsWhatItReceives) {
  make_sequence(21);
  ASSERT_EQ(call("run s --output o --frames :20 --segmentation off --motion off --quiet").code, 0);
  const Outcome outcome = script(
      "record() { $SLAM record ros2: --color /camera/color/image_raw "
      "--depth /camera/aligned_depth_to_color/image_raw --camera s/camera.yaml --reception every-frame "
      "--frames :20 --output $1 & $PEER play s --lossless --to-recorder || exit 9; wait $!; }\n"
      "record r && record r.mcap");
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "20 frames: r.mcap")) << outcome.out;
  for (const char* recorded : {"r", "r.mcap"}) {
    ASSERT_EQ(call(fmt::format(
                       "run {} --camera s/camera.yaml --output {}.o --segmentation off --motion off --quiet",
                       recorded, recorded))
                  .code,
              0);
    EXPECT_EQ(content(folder_ / fmt::format("{}.o/trajectory.txt", recorded)),
              content(folder_ / "o/trajectory.txt"))
        << recorded;
  }
}

TEST_F(Ros2CommandLine, RefusesToRecordWithoutTopics) {
  expect_refusal("record ros2: --output r", "topics of the images are missing");
  expect_refusal("record ros2: --color image --depth /depth --output r", "is no name of a topic");
}

TEST_F(Ros2CommandLine, RefusesWhatMakesNoSense) {
  expect_refusal("ros2 --color image --depth /depth", "is no name of a topic");
  expect_refusal(fmt::format("{} --save-map nowhere/m.map", kTopics), "nowhere/m.map");
  expect_refusal(fmt::format("{} --localisation-only", kTopics), "there is no map");
  expect_refusal(fmt::format("{} --reception never", kTopics), "--reception");
}

}  // namespace
}  // namespace stdc::app
