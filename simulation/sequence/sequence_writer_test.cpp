#include "simulation/sequence/sequence_writer.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "core/images/image_codec.hpp"

namespace stdc::simulation {
namespace {

namespace fs = std::filesystem;

class SequenceWriterTest : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / ("stdc_writer_" + std::to_string(getpid()));
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  static RenderedFrame frame(double timestamp, int shade) {
    RenderedFrame f;
    f.image.timestamp = timestamp;
    f.image.colour = cv::Mat(64, 80, CV_8UC3, cv::Scalar(shade, 2, 3));
    f.image.depth = cv::Mat(64, 80, CV_16UC1, cv::Scalar(5000 + shade));
    f.mask = cv::Mat(64, 80, CV_8UC1, cv::Scalar(255));
    f.world_from_cam.translation = {0.5, -1, 2};
    return f;
  }
  static std::string text(const fs::path& path) {
    std::ifstream file(path);
    std::stringstream content;
    content << file.rdbuf();
    return content.str();
  }
  static cv::Mat image(const fs::path& path, bool depth = false) {
    const std::string file = text(path);
    const Bytes bytes(reinterpret_cast<const std::uint8_t*>(file.data()), file.size());
    return (depth ? decode_depth(bytes, {80, 64}) : decode_colour(bytes, {80, 64}, ColourMode::as_stored))
        .image;
  }
  static bool empty_but_for(const fs::path& folder, int count) {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == count;
  }

  fs::path root_;
};

TEST_F(SequenceWriterTest, WritesTheTumLayout) {
  const fs::path out = root_ / "new" / "sequence";
  SequenceWriter writer(out, Camera(), 2, false);
  writer.write(1, frame(10.5, 40));
  writer.write(0, frame(10.25, 20));
  EXPECT_FALSE(fs::exists(out));
  writer.finish();
  EXPECT_NE(text(out / "rgb.txt").find("10.250000 rgb/10.250000.png\n10.500000 rgb/10.500000.png\n"),
            std::string::npos);
  EXPECT_NE(text(out / "depth.txt").find("10.250000 depth/10.250000.png\n"), std::string::npos);
  EXPECT_NE(text(out / "groundtruth.txt")
                .find("10.250000 0.500000000 -1.000000000 2.000000000 0.000000000 0.000000000 0.000000000 "
                      "1.000000000"),
            std::string::npos);
  EXPECT_NE(text(out / "camera.yaml").find("fx: 525\n"), std::string::npos);
  const cv::Mat depth = image(out / "depth/10.500000.png", true);
  ASSERT_EQ(depth.type(), CV_16UC1);
  EXPECT_EQ(depth.at<std::uint16_t>(5, 5), 5040);
  EXPECT_EQ(image(out / "rgb/10.250000.png").at<cv::Vec3b>(3, 3), cv::Vec3b(20, 2, 3));
  EXPECT_EQ(image(out / "mask/10.250000.png").type(), CV_8UC1);
  EXPECT_TRUE(empty_but_for(out.parent_path(), 1));  // nothing left beside it
}

TEST_F(SequenceWriterTest, WritesMovedOnlyForFramesThatHaveIt) {
  for (const bool has_moved : {false, true}) {
    const fs::path out = root_ / (has_moved ? "with" : "without");
    SequenceWriter writer(out, Camera(), 1, false);
    RenderedFrame one = frame(1, 20);
    if (has_moved) one.moved = one.mask;
    writer.write(0, one);
    writer.finish();
    EXPECT_EQ(fs::exists(out / "moved"), has_moved);
    EXPECT_EQ(fs::exists(out / "moved/1.000000.png"), has_moved);
  }
}

TEST_F(SequenceWriterTest, LeavesNothingWhenItIsAbandoned) {
  {
    SequenceWriter writer(root_ / "sequence", Camera(), 2, false);
    writer.write(0, frame(1, 1));
  }
  EXPECT_TRUE(empty_but_for(root_, 0));
}

TEST_F(SequenceWriterTest, DoesNotTouchAFolderWithSomethingInIt) {
  const fs::path out = root_ / "full";
  fs::create_directories(out);
  std::ofstream(out / "thesis.txt") << "words";
  EXPECT_THROW(SequenceWriter(out, Camera(), 1, false), Error);
  EXPECT_THROW(SequenceWriter(out, Camera(), 1, true), Error);  // it is no sequence
  EXPECT_EQ(text(out / "thesis.txt"), "words");
  std::ofstream(root_ / "file") << "x";
  EXPECT_THROW(SequenceWriter(root_ / "file", Camera(), 1, true), Error);
}

TEST_F(SequenceWriterTest, ReplacesASequenceOnlyWhenTold) {
  const fs::path out = root_ / "sequence";
  for (const int shade : {20, 60}) {
    SequenceWriter writer(out, Camera(), 1, shade == 60);
    writer.write(0, frame(1, shade));
    writer.finish();
  }
  EXPECT_EQ(image(out / "rgb/1.000000.png").at<cv::Vec3b>(0, 0)[0], 60);
  EXPECT_THROW(SequenceWriter(out, Camera(), 1, false), Error);
}

TEST_F(SequenceWriterTest, ReportsAPlaceThatCannotBeWritten) {
  std::ofstream(root_ / "file") << "x";
  EXPECT_THROW(SequenceWriter(root_ / "file" / "sequence", Camera(), 1, false), Error);
  EXPECT_THROW(SequenceWriter("/proc/sequence", Camera(), 1, false), Error);
  EXPECT_THROW(SequenceWriter(root_ / "sequence", Camera(), 0, false), Error);
}

}  // namespace
}  // namespace stdc::simulation
