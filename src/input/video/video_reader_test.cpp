#include "input/video/video_reader.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "core/files/test_folder.hpp"
#include "input/video/test_video.hpp"
#include "input/video/video_index.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;
using test::video_frame;

class VideoReaderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_ffmpeg()) GTEST_SKIP() << test::kNeedsFfmpeg;
  }
  VideoReader open(const std::string& name) const {
    return VideoReader({folder_ / name, read_video_index(folder_ / name).size});
  }
  static bool same(const cv::Mat& rgb, const cv::Mat& bgr) {
    cv::Mat turned;
    cv::cvtColor(rgb, turned, cv::COLOR_RGB2BGR);
    return turned.size() == bgr.size() && std::memcmp(turned.data, bgr.data, bgr.total() * 3) == 0;
  }
  TestFolder folder_;
};

TEST_F(VideoReaderTest, GivesEveryFrameOnceInAnyOrder) {
  test::write_video(folder_ / "v.mkv", test::video_frames(12), test::kLossless);
  VideoReader video = open("v.mkv");
  for (const int i : {0, 1, 2, 5, 11, 3, 3, 4, 0}) {
    const auto image = video.frame(i);
    ASSERT_TRUE(image) << i;
    EXPECT_TRUE(same(*image, video_frame(i))) << i;
  }
  EXPECT_FALSE(video.frame(12));
  EXPECT_EQ(video.problem(), "") << "it has ended, that is all";
  EXPECT_FALSE(video.frame(13));
  EXPECT_TRUE(same(video.frame(11).value(), video_frame(11)));
}

/// Neither rates that change nor rotation that the file asks for are made up for.
TEST_F(VideoReaderTest, GivesFramesAsTheyAreStored) {
  auto phone = test::kLikePhones;
  phone.insert(phone.end(), {"-vf", "setpts=if(gt(N\\,5)\\,N+90\\,N)/30/TB", "-vsync", "0"});
  test::write_video(folder_ / "straight.mp4", test::video_frames(10), phone);
  ChildProcess turn({"ffmpeg", "-nostdin", "-loglevel", "error", "-i", (folder_ / "straight.mp4").string(),
                     "-c", "copy", "-metadata:s:v:0", "rotate=90", (folder_ / "v.mp4").string()});
  ASSERT_EQ(turn.finish(), 0) << turn.complaints();
  const VideoIndex index = read_video_index(folder_ / "v.mp4");
  EXPECT_EQ(index.frames, 10);
  EXPECT_NEAR(index.times.at(9) - index.times.at(0), 99 / 30.0, 1e-3);
  VideoReader video = open("v.mp4");
  for (int i = 0; i < 10; ++i) {
    const auto image = video.frame(i);
    ASSERT_TRUE(image) << i;
    ASSERT_EQ(image->size(), cv::Size(320, 256));
    cv::Mat turned;
    cv::cvtColor(*image, turned, cv::COLOR_RGB2BGR);
    // With loss it is still nearer to its own frame than to those beside it.
    EXPECT_LT(cv::norm(turned, video_frame(i)), 0.5 * cv::norm(turned, video_frame(i + 1))) << i;
  }
  EXPECT_FALSE(video.frame(10));
}

TEST_F(VideoReaderTest, GivesTheSameBytesEachTime) {
  test::write_video(folder_ / "v.mp4", test::video_frames(6), test::kLikePhones);
  VideoReader a = open("v.mp4"), b = open("v.mp4");
  for (int i = 0; i < 6; ++i) {
    const cv::Mat image = a.frame(i).value();
    EXPECT_EQ(std::memcmp(image.data, b.frame(i).value().data, image.total() * 3), 0) << i;
  }
}

TEST_F(VideoReaderTest, EndsWhereAVideoIsCut) {
  test::write_video(folder_ / "v.mp4", test::video_frames(60), test::kLikePhones);
  test::cut_file(folder_ / "v.mp4", 0.7);
  VideoReader video = open("v.mp4");
  int frames = 0;
  while (video.frame(frames)) ++frames;
  EXPECT_GT(frames, 5);
  EXPECT_LT(frames, 58);
  EXPECT_NE(video.problem(), "");
  EXPECT_TRUE(video.frame(frames - 1)) << "the frames before are still to be had";
}

TEST_F(VideoReaderTest, LeavesNoProcessBehind) {
  test::write_video(folder_ / "v.mkv", test::video_frames(40), test::kLossless);
  {
    VideoReader read = open("v.mkv"), left = open("v.mkv"), started_again = open("v.mkv");
    while (read.frame(39) && read.frame(40)) {
    }
    left.frame(2);  // ffmpeg waits in the middle of the next ones
    started_again.frame(3);
    started_again.frame(1);
  }
  siginfo_t info{};
  EXPECT_TRUE(waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) != 0 && errno == ECHILD);
}

/// A program in front of PATH while this lives.
class PathBefore {
 public:
  explicit PathBefore(const std::string& folder) : path_(std::getenv("PATH")) {
    setenv("PATH", (folder + ":" + path_).c_str(), 1);
  }
  ~PathBefore() { setenv("PATH", path_.c_str(), 1); }

 private:
  std::string path_;
};

/// Later versions of ffmpeg know -fps_mode alone.
TEST_F(VideoReaderTest, TakesAnFfmpegWithoutTheOldOption) {
  test::write_video(folder_ / "v.mkv", test::video_frames(4), test::kLossless);
  VideoReader video = open("v.mkv");
  const auto script = folder_.write("later/ffmpeg",
                                    "#!/bin/sh\nfor word; do if [ \"$word\" = -vsync ]; then\n"
                                    "echo \"Unrecognized option 'vsync'.\" >&2; exit 1; fi; done\n"
                                    "PATH=" +
                                        std::string(std::getenv("PATH")) + "\nffmpeg \"$@\"\n");
  std::filesystem::permissions(script, std::filesystem::perms::owner_all);
  const PathBefore later((folder_ / "later").string());
  for (const int i : {0, 3, 1}) EXPECT_TRUE(same(video.frame(i).value(), video_frame(i))) << i;
}

TEST_F(VideoReaderTest, SaysThatThereIsNoFfmpeg) {
  test::write_video(folder_ / "v.mkv", test::video_frames(2), test::kLossless);
  VideoReader video = open("v.mkv");
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder_ / "empty").c_str(), 1);
  const std::string reading = message_of([&] { video.frame(0); });
  const std::string index = message_of([&] { read_video_index(folder_ / "v.mkv"); });
  setenv("PATH", path.c_str(), 1);
  for (const std::string& message : {reading, index}) {
    EXPECT_NE(
        message.find("v.mkv: is a video, and the program ffmpeg, which decodes videos, is not installed; apt "
                     "install ffmpeg"),
        std::string::npos)
        << message;
  }
}

}  // namespace
}  // namespace stdc
