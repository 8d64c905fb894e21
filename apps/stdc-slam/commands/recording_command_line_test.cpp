// Runs the program on recordings that other people's writers make of a sequence, where they are installed.
#include "commands/test_command_line.hpp"

namespace stdc::app {
namespace {

class RecordingCommandLine : public CommandLine {
 protected:
  /// Makes recordings of the sequence "s" in "r". False if their writer is not installed.
  bool make_recordings(const std::string& names) const {
    const std::string command = fmt::format("cd {} && {} s r --only {} > .made 2>&1", folder_.path().string(),
                                            STDC_SOURCE_FOLDER "/scripts/write_test_recordings", names);
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status));
    constexpr int kNotInstalled = 3, kNoPython = 127, kNoInterpreter = 126;
    const int code = WEXITSTATUS(status);
    if (code == kNotInstalled || code == kNoPython || code == kNoInterpreter) return false;
    EXPECT_EQ(code, 0) << content(folder_ / ".made");
    return code == 0;
  }
  std::string trajectory(const std::string& input, const std::string& options = "") const {
    fs::remove_all(folder_ / "o");
    const Outcome outcome = call("run " + input + " --output o --segmentation off --quiet " + options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return content(folder_ / "o/trajectory.txt");
  }
};

TEST_F(RecordingCommandLine, BagsGiveThePosesOfTheFolder) {
  make_sequence();
  if (!make_recordings("raw.bag png.bag raw.bz2.bag raw.lz4.bag")) {
    GTEST_SKIP() << "python3-rosbag is not installed, or not the messages: see scripts/write_test_recordings";
  }
  const std::string expected = trajectory("s");
  EXPECT_GT(lines(expected), 10);
  for (const char* name : {"raw.bag", "png.bag", "raw.bz2.bag", "raw.lz4.bag"}) {
    EXPECT_EQ(trajectory(fmt::format("r/{}", name)), expected) << name;
    EXPECT_TRUE(fs::exists(folder_ / "o/summary.json"));
    EXPECT_TRUE(contains(content(folder_ / "o/summary.json"), "\"rmse\"")) << name;  // it has a ground truth
  }
}

TEST_F(RecordingCommandLine, RecordingsOfRos2GiveThePosesOfTheFolder) {
  make_sequence();
  if (!make_recordings(
          "raw.mcap png.lz4.mcap raw.zstd.mcap raw.ros1.mcap raw_db3 png_db3_split raw_mcap_split")) {
    GTEST_SKIP() << "the writers of npm are not where NODE_PATH says: see scripts/write_test_recordings";
  }
  const std::string expected = trajectory("s");
  for (const char* name : {"raw.mcap", "png.lz4.mcap", "raw.zstd.mcap", "raw.ros1.mcap", "raw_db3",
                           "png_db3_split", "raw_mcap_split"}) {
    EXPECT_EQ(trajectory(fmt::format("r/{}", name)), expected) << name;
  }
}

TEST_F(RecordingCommandLine, ADamagedBagIsReadAsFarAsItGoes) {
  make_sequence();
  if (!make_recordings("raw.bag")) GTEST_SKIP() << "python3-rosbag is not installed";
  fs::resize_file(folder_ / "r/raw.bag", fs::file_size(folder_ / "r/raw.bag") / 2);
  const Outcome outcome = call("run r/raw.bag --output o --segmentation off --quiet");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.err, "raw.bag: ends within the chunk at byte ")) << outcome.err;
  EXPECT_GT(lines(content(folder_ / "o/trajectory.txt")), 3);
}

TEST_F(RecordingCommandLine, TopicsThatAreNotThereAreNamed) {
  const std::string bag = STDC_SOURCE_FOLDER "/src/input/recordings/testdata/raw.bz2.bag";
  expect_refusal("run " + bag + " --output o --color /none",
                 "raw.bz2.bag: has no topic /none; give another --color");
  expect_refusal("run " + bag + " --output o --truth /none", "has no topic /none with poses");
  expect_refusal("run " + bag + " --output o --rate 30", "--rate");
}

}  // namespace
}  // namespace stdc::app
