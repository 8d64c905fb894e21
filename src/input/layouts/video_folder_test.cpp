#include "input/layouts/video_folder.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <opencv2/imgproc.hpp>

#include "input/frame_decoder.hpp"
#include "input/open_source.hpp"
#include "input/test_layouts.hpp"
#include "input/video/test_video.hpp"

namespace stdc {
namespace {

using test::layout_depth;
using test::message_of;
using test::video_frame;

class VideoFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_ffmpeg()) GTEST_SKIP() << test::kNeedsFfmpeg;
  }

  /// A recording of Stray Scanner whose video has `frames` frames of 320 x 256.
  void write_scanner(int frames, int rows, const std::vector<std::string>& codec) const {
    std::string odometry = "timestamp, frame, x, y, z, qx, qy, qz, qw\n";
    for (int i = 0; i < rows; ++i) {
      folder_.write(fmt::format("depth/{:06d}.png", i), encode_png(layout_depth(1500 + i)));
      odometry += fmt::format("{:.6f}, {:06d}, {}, 0, 0, 0, 0, 0, 1\n", 5000 + i / 60.0, i, 0.01 * i);
    }
    folder_.write("odometry.csv", odometry);
    folder_.write("camera_matrix.csv", std::string("280.0, 0.0, 159.5\n0.0, 280.0, 127.5\n0.0, 0.0, 1.0\n"));
    test::write_video(folder_ / "rgb.mp4", test::video_frames(frames), codec);
  }
  /// Depth images `first`, ... of a folder of any kind.
  void write_depth(int first, int count) const {
    for (int i = first; i < first + count; ++i) {
      folder_.write(fmt::format("depth/{}.png", i), encode_png(layout_depth(1000 + i)));
    }
    Camera camera = test::layout_camera();
    folder_.write("camera.yaml", format_camera(camera));
  }

  test::TestFolder folder_;
};

std::vector<std::string> lossless_mp4() {
  return {"-c:v", "libx264rgb", "-crf", "0", "-movflags", "+faststart"};
}

TEST_F(VideoFolder, StrayScannerIsReadAsTheAppWritesIt) {
  write_scanner(8, 8, lossless_mp4());
  const auto source = open_source(folder_.path());
  EXPECT_EQ(source->kind(), "stray-scanner");
  EXPECT_FALSE(source->frame_count()) << "not known before the end";
  EXPECT_EQ(source->expected_frame_count(), 8);
  EXPECT_EQ(source->frame_names().at(3), "000003");
  EXPECT_EQ(source->cameras()->colour.width, 320);
  EXPECT_EQ(source->streams().at(0).name, "rgb.mp4");
  EXPECT_EQ(source->notes().size(), 1U) << "of the poses only";
  const FrameDecoder decoder(*source->cameras());
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < 8; ++i) {
      const auto frame = source->next();
      ASSERT_TRUE(frame);
      EXPECT_EQ(frame->name, fmt::format("{:06d}", i));
      EXPECT_NEAR(frame->timestamp, 5000 + i / 60.0, 1e-6);
      const RgbdImage image = decoder.decode(*frame, ColourMode::as_stored);
      EXPECT_EQ(cv::norm(image.colour, video_frame(i)), 0) << i;
      EXPECT_EQ(image.depth.at<std::uint16_t>(128, 160), 1500 + i);
      cv::Mat grey;
      cv::cvtColor(video_frame(i), grey, cv::COLOR_BGR2GRAY);
      EXPECT_EQ(cv::norm(decoder.colour(*frame, ColourMode::grey), grey), 0) << i;
      EXPECT_FALSE(frame->images->colour_file());
    }
    EXPECT_FALSE(source->next());
    EXPECT_TRUE(source->faults().empty());
    source->rewind();
  }
}

TEST_F(VideoFolder, SaysThatThereAreNotAsManyFramesAsLines) {
  write_scanner(8, 6, test::kLikePhones);
  const auto more = open_source(folder_.path());
  EXPECT_EQ(more->expected_frame_count(), 6);
  EXPECT_EQ(more->colour_without_depth(), 2);
  EXPECT_NE(more->notes().front().find("rgb.mp4: holds 8 frames, but odometry.csv 6 lines: 6 have both"),
            std::string::npos)
      << more->notes().front();
  write_scanner(4, 6, {"-y", "-c:v", "libx264", "-pix_fmt", "yuv420p"});
  const auto fewer = open_source(folder_.path());
  EXPECT_EQ(fewer->expected_frame_count(), 4);
  EXPECT_NE(fewer->notes().front().find("holds 4 frames, but odometry.csv 6 lines: 4 have both"),
            std::string::npos);
}

TEST_F(VideoFolder, UsesADamagedVideoUpToTheDamage) {
  write_scanner(60, 60, test::kLikePhones);
  test::cut_file(folder_ / "rgb.mp4", 0.7);
  const auto source = open_source(folder_.path());
  int frames = 0;
  for (int round = 0; round < 2; ++round, source->rewind()) {
    EXPECT_TRUE(source->faults().empty());
    for (frames = 0; source->next(); ++frames) {
    }
    EXPECT_GT(frames, 5);
    EXPECT_LT(frames, *source->expected_frame_count());
    ASSERT_EQ(source->faults().size(), 1U);
    EXPECT_NE(
        source->faults().front().find(fmt::format("rgb.mp4: cannot be decoded from frame {} on (", frames)),
        std::string::npos)
        << source->faults().front();
    EXPECT_NE(source->faults().front().find(fmt::format("): {} of {} frames are left out",
                                                        *source->expected_frame_count() - frames,
                                                        *source->expected_frame_count())),
              std::string::npos)
        << source->faults().front();
  }
}

TEST_F(VideoFolder, ImagesOutliveTheSource) {
  write_scanner(5, 5, lossless_mp4());
  std::vector<SourceFrame> frames;
  {
    const auto source = open_source(folder_.path());
    for (int i = 0; i < 3; ++i) frames.push_back(source->next().value());
  }
  siginfo_t info{};
  EXPECT_NE(waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT), 0) << "no process is left behind";
  EXPECT_EQ(cv::norm(frames[1].images->colour({}, ColourMode::as_stored), video_frame(1)), 0);
  EXPECT_NE(message_of([&] {
              frames[1].images->colour({640, 480}, ColourMode::grey);
            }).find("rgb.mp4 (frame 1): is 320 x 256 pixels, but the camera has 640 x 480; give the camera"),
            std::string::npos);
}

TEST_F(VideoFolder, AVideoBesideDepthImagesWillDo) {
  test::write_video(folder_ / "v.mkv", test::video_frames(6, {80, 64}), test::kLossless);
  write_depth(1, 6);
  const auto source = open_source(folder_.path());
  EXPECT_EQ(source->kind(), "open3d");
  EXPECT_TRUE(source->notes().empty()) << source->notes().front();
  const FrameDecoder decoder(*source->cameras());
  for (int i = 0; i < 6; ++i) {
    const auto frame = source->next();
    ASSERT_TRUE(frame);
    EXPECT_NEAR(frame->timestamp, i / 30.0, 2e-3) << "as the video says";
    const RgbdImage image = decoder.decode(*frame, ColourMode::as_stored);
    EXPECT_EQ(cv::norm(image.colour, video_frame(i, {80, 64})), 0);
    EXPECT_EQ(image.depth.at<std::uint16_t>(30, 30), 1001 + i) << "numbers begin at 1";
  }
  SourceOptions options;
  options.rate = 10;
  const auto slower = open_source(folder_.path(), options);
  slower->next();
  EXPECT_NEAR(slower->next()->timestamp, 0.1, 1e-12);
}

TEST_F(VideoFolder, PairsByNumbersFromZeroOrInOrder) {
  test::write_video(folder_ / "v.mp4", test::video_frames(6, {80, 64}), test::kLikePhones);
  write_depth(0, 5);
  std::filesystem::remove(folder_ / "depth/2.png");
  const auto source = open_source(folder_.path());
  EXPECT_EQ(source->frame_names(), (std::vector<std::string>{"000000", "000001", "000003", "000004"}));
  EXPECT_EQ(source->colour_without_depth(), 2);
  EXPECT_NE(source->notes().front().find("v.mp4: holds 6 frames, but there are 4 depth images: 4 have both"),
            std::string::npos);
  std::filesystem::remove_all(folder_ / "depth");
  for (int i = 0; i < 6; ++i) {
    folder_.write(fmt::format("depth/{:.6f}.png", 1305031102.5 + i / 30.0),
                  encode_png(layout_depth(1000 + i)));
  }
  EXPECT_EQ(open_source(folder_.path())->expected_frame_count(), 6);
  folder_.write("depth/1305031109.0.png", encode_png(layout_depth(1000)));
  EXPECT_NE(message_of([&] {
              open_source(folder_.path());
            }).find("v.mp4: holds 6 frames, but there are 7 depth images without frame numbers"),
            std::string::npos);
}

TEST_F(VideoFolder, RefusesWhatItCannotUse) {
  write_depth(0, 2);
  folder_.write("a.mp4", std::string("?"));
  EXPECT_NE(
      message_of([&] { open_source(folder_.path()); }).find("a.mp4: holds no video that ffmpeg can read"),
      std::string::npos);
  EXPECT_NE(
      message_of([&] { open_source(folder_ / "a.mp4"); }).find("a.mp4: is a video without depth images"),
      std::string::npos);
  folder_.write("._a.mp4", std::string("?"));
  folder_.write("b.MOV", std::string("?"));
  EXPECT_NE(message_of([&] { open_source(folder_.path()); }).find("holds several videos: a.mp4 and b.MOV"),
            std::string::npos);
}

}  // namespace
}  // namespace stdc
