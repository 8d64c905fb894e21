#include "input/layouts/tum_writer.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "core/files/test_folder.hpp"
#include "core/files/text_file.hpp"
#include "input/layouts/tum_sequence.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

class TumWriterTest : public testing::Test {
 protected:
  static cv::Mat colour(int shade) { return {cv::Mat(64, 80, CV_8UC3, cv::Scalar(shade, 2, 3))}; }
  static cv::Mat depth(int raw) { return {cv::Mat(64, 80, CV_16UC1, cv::Scalar(raw))}; }
  int entries(const std::string& name = "") const {
    return static_cast<int>(
        std::distance(fs::directory_iterator(root_.path() / name), fs::directory_iterator()));
  }
  std::string text(const std::string& name) const { return read_file(root_ / name, ""); }
  static void write_one(TumWriter& writer) {
    writer.write_image("rgb", 1, colour(7));
    writer.write_image("depth", 1.004, depth(5000));
    writer.write_camera(Camera());
  }

  test::TestFolder root_;
};

TEST_F(TumWriterTest, WritesWhatTheReaderReads) {
  TumWriter writer({root_ / "new/sequence/"});
  EXPECT_EQ(writer.folder(), root_ / "new/sequence");
  std::vector<std::thread> threads;
  for (const int i : {3, 1, 0, 2}) {  // in any order, at once
    threads.emplace_back([&writer, i] {
      writer.write_image("rgb", 10 + i / 10.0, colour(i));
      writer.write_image("depth", 10.004 + i / 10.0, depth(5000 + i));
      writer.write_image("mask", 10 + i / 10.0, cv::Mat(64, 80, CV_8UC1, cv::Scalar(255)));
    });
  }
  for (std::thread& thread : threads) thread.join();
  writer.write_camera(Camera());
  writer.write_text("groundtruth.txt", "10 0 0 0 0 0 0 1\n");
  EXPECT_FALSE(fs::exists(root_ / "new/sequence"));
  writer.commit();
  EXPECT_EQ(entries("new"), 1);  // nothing left beside it

  const TumSequence sequence(root_ / "new/sequence");
  ASSERT_EQ(sequence.frames().size(), 4U);
  EXPECT_NEAR(sequence.frames()[2].timestamp, 10.2, 1e-9);
  EXPECT_NEAR(sequence.frames()[2].depth_timestamp, 10.204, 1e-9);
  EXPECT_EQ(sequence.ground_truth().poses.size(), 1U);
  EXPECT_EQ(find_camera(sequence, {}), Camera());
  EXPECT_TRUE(fs::exists(root_ / "new/sequence/mask/10.200000.png"));
  EXPECT_EQ(text("new/sequence/rgb.txt").find("# color images\n# timestamp filename\n10.000000 rgb/10.0"),
            0U);
}

TEST_F(TumWriterTest, LeavesNothingWhenItIsAbandoned) {
  {
    TumWriter writer({root_ / "new/sequence"});
    write_one(writer);
  }
  EXPECT_EQ(entries(), 0);
}

TEST_F(TumWriterTest, ReplacesOnlyWhatItMay) {
  const auto target = [this](const std::string& replaceable) {
    return TumTarget{root_ / "s", {"rgb", "depth", "unknown"}, replaceable, "--inpaint", "free it"};
  };
  fs::create_directory(root_ / "s");
  for (int i = 0; i < 2; ++i) {  // first in place of an empty folder
    TumWriter writer(target("rgb.txt"));
    write_one(writer);
    writer.commit();
  }
  EXPECT_EQ(test::message_of([&] { TumWriter{target("")}; }),
            (root_ / "s").string() + ": the folder is not empty; free it");
  EXPECT_EQ(test::message_of([&] { TumWriter{target("unknown")}; }),
            (root_ / "s").string() + ": holds a sequence that --inpaint did not write; free it");
  root_.write("s/thesis.txt", std::string("words"));
  EXPECT_EQ(test::message_of([&] { TumWriter{target("rgb.txt")}; }),
            (root_ / "s").string() + ": has something else in it (\"thesis.txt\"); free it");
  EXPECT_EQ(text("s/thesis.txt"), "words");
}

TEST_F(TumWriterTest, ReportsAPlaceThatCannotBeWritten) {
  root_.write("file", std::string("x"));
  EXPECT_NE(test::message_of([&] { TumWriter{TumTarget{root_ / "file"}}; }), "");
  EXPECT_NE(test::message_of([&] { TumWriter{TumTarget{root_ / "file/sequence"}}; }), "");
  EXPECT_NE(test::message_of([&] { TumWriter{TumTarget{"/proc/sequence"}}; }), "");
}

TEST_F(TumWriterTest, CopiesAFileOrSaysThatItIsMissing) {
  root_.write("truth", std::string("words"));
  TumWriter writer({root_ / "s"});
  writer.copy_file("groundtruth.txt", root_ / "truth");
  EXPECT_NE(test::message_of([&] { writer.copy_file("other.txt", root_ / "none"); }), "");
  writer.commit();
  EXPECT_EQ(text("s/groundtruth.txt"), "words");
}

}  // namespace
}  // namespace stdc
