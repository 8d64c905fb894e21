#include "input/trajectory.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/files/test_folder.hpp"
#include "core/random.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;

Trajectory parse(const std::string& text) {
  std::istringstream stream(text);
  return read_trajectory(stream, "t.txt");
}

std::string message_for(const std::string& text) {
  return message_of([&] { parse(text); });
}

TEST(Trajectory, ReadsTumLines) {
  const Trajectory read = parse("# time ...\n1.5 1 2 3 0 0 0 1\r\n\n2.5 -1 0 1e-3 0.6 0 0 0.8");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].timestamp, 1.5);
  EXPECT_EQ(read[0].world_from_cam.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(read[1].world_from_cam.rotation.x(), 0.6, 1e-12);
  EXPECT_NEAR(read[1].world_from_cam.rotation.w(), 0.8, 1e-12);
}

TEST(Trajectory, WritesWhatItReads) {
  Random random(3);
  Trajectory written;
  for (int i = 0; i < 50; ++i) {
    Vector6d twist;
    for (int k = 0; k < 6; ++k) twist[k] = random.uniform(-2, 2);
    written.push_back({1305031102.175304 + i / 30.0, Pose::exp(twist)});
  }
  const std::string text = format_trajectory(written);
  EXPECT_EQ(text.substr(0, 18), "1305031102.175304 ");
  const Trajectory read = parse(text);
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_NEAR(read[i].timestamp, written[i].timestamp, 1e-6);
    EXPECT_LT((read[i].world_from_cam.inverse() * written[i].world_from_cam).log().norm(), 1e-8);
  }
  EXPECT_EQ(format_trajectory({}), "");
}

TEST(Trajectory, NamesTheLineAtFault) {
  const std::string good = "1 0 0 0 0 0 0 1\n";
  EXPECT_EQ(message_for(good + "2 0 0 0 0 0 1\n"),
            "t.txt:2: has 7 values instead of 8; write each line as: timestamp tx ty tz qx qy qz qw");
  EXPECT_EQ(message_for("# c\n\n2 0 x 0 0 0 0 1"),
            "t.txt:3: 'x' is not a finite number; write each line as: timestamp tx ty tz qx qy qz qw");
  EXPECT_NE(message_for("2 0 nan 0 0 0 0 1").find("t.txt:1: 'nan' is not a finite number"),
            std::string::npos);
  EXPECT_NE(message_for("nan 0 0 0 0 0 0 1").find("t.txt:1: the timestamp 'nan'"), std::string::npos);
  EXPECT_NE(message_for("1e12 0 0 0 0 0 0 1").find("t.txt:1: the timestamp '1e12' is too large"),
            std::string::npos);
  EXPECT_NE(message_for("1 0 0 0 0 0 0 0").find("t.txt:1: the quaternion has length 0"), std::string::npos);
  EXPECT_NE(message_for("1 0 0 0 1e300 0 0 1e300").find("t.txt:1: the quaternion"), std::string::npos);
  EXPECT_NE(message_for(good + good).find("t.txt:2: the timestamp 1.000000 is not later"), std::string::npos);
  EXPECT_NE(message_for(good + "0.5 0 0 0 0 0 0 1").find("t.txt:2: "), std::string::npos);
  EXPECT_NE(message_for("# nothing\n").find("t.txt: has no poses"), std::string::npos);
}

TEST(Trajectory, NamesAMissingFile) {
  const TestFolder folder;
  EXPECT_NE(message_of([&] { read_trajectory(folder / "none.txt"); }).find("none.txt: cannot be opened"),
            std::string::npos);
}

}  // namespace
}  // namespace stdc
