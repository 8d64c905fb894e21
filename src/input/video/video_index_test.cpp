#include "input/video/video_index.hpp"

#include <gtest/gtest.h>

#include "core/files/test_folder.hpp"
#include "input/video/ffmpeg.hpp"
#include "input/video/test_video.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;

VideoIndex index_of(const std::vector<std::string>& lines) {
  VideoIndexReader reader;
  for (const std::string& line : lines) reader.add(line);
  return reader.result("v.mp4");
}

TEST(VideoIndex, HasTheTimesInTheOrderOfShowing) {
  const VideoIndex index =
      index_of({"#software: Lavf", "#tb 0: 1/1000", "#dimensions 0: 640x480", "0,  -33,    0,  33, 900, 0x12",
                "0,    0,   66,  33,  90, 0x13, F=0x0", "0,   33,   33,  33,  90, 0x14"});
  EXPECT_EQ(index.size, cv::Size(640, 480));
  EXPECT_EQ(index.frames, 3);
  EXPECT_EQ(index.times, (std::vector<double>{0, 0.033, 0.066}));
}

TEST(VideoIndex, HasNoTimesWhereTheyAreNotOfOneFrameEach) {
  EXPECT_TRUE(index_of({"#tb 0: 1/30", "0,0,1,1,1,0", "0,0,1,1,1,0"}).times.empty());
  EXPECT_TRUE(index_of({"#tb 0: 1/30", "0,0,-9223372036854775808,1,1,0", "0,0,1,1,1,0"}).times.empty());
  const VideoIndex damaged = index_of({"#tb 0: 1/0", "0,0,1,1", "0,0,2,1", "0,x", "", "0,0"});
  EXPECT_EQ(damaged.frames, 2);
  EXPECT_TRUE(damaged.times.empty());
}

TEST(VideoIndex, RefusesSizesOfNoCamera) {
  for (const char* size : {"16385x2", "2x16385", "16000x16000", "9223372036854775807x9223372036854775807"}) {
    EXPECT_NE(message_of([&] {
                index_of({std::string("#dimensions 0: ") + size});
              }).find("v.mp4: says that its images are"),
              std::string::npos)
        << size;
  }
  EXPECT_TRUE(index_of({"#dimensions 0: -4x3"}).size.empty());
  EXPECT_TRUE(index_of({"#dimensions 0: 4x99999999999999999999"}).size.empty());
}

TEST(VideoIndex, OfVideosThatFfmpegWrites) {
  if (!test::has_ffmpeg()) GTEST_SKIP() << test::kNeedsFfmpeg;
  const TestFolder folder;
  for (const char* name : {"a.mp4", "b.mkv", "-i.mov", "a b'%d.avi"}) {
    test::write_video(folder / name, test::video_frames(20), test::kLikePhones);
    const VideoIndex index = read_video_index(folder / name);
    EXPECT_EQ(index.size, cv::Size(320, 256)) << name;
    EXPECT_EQ(index.frames, 20) << name;
    if (folder / name != folder / "a b'%d.avi") {  // AVI has no times for frames that come in another order
      ASSERT_EQ(index.times.size(), 20U) << name;
      EXPECT_NEAR(index.times[19] - index.times[0], 19 / 30.0, 2e-3) << name;
    }
  }
}

TEST(VideoIndex, SaysWhatIsNoVideo) {
  if (!test::has_ffmpeg()) GTEST_SKIP() << test::kNeedsFfmpeg;
  const TestFolder folder;
  const auto text = folder.write("v.mp4", std::string("no video at all"));
  EXPECT_NE(message_of([&] { read_video_index(text); }).find("v.mp4: holds no video that ffmpeg can read ("),
            std::string::npos);
  // A list of other files must not be followed.
  test::write_video(folder / "real.mp4", test::video_frames(3), test::kLikePhones);
  const auto list =
      folder.write("list.mp4", "ffconcat version 1.0\nfile '" + (folder / "real.mp4").string() + "'\n");
  EXPECT_NE(message_of([&] { read_video_index(list); }).find("holds no video"), std::string::npos);
  // The index of an MP4 file is at its end, where an app that was stopped has not written it.
  test::write_video(folder / "cut.mp4", test::video_frames(20), {"-c:v", "libx264", "-pix_fmt", "yuv420p"});
  test::cut_file(folder / "cut.mp4", 0.7);
  EXPECT_NE(message_of([&] { read_video_index(folder / "cut.mp4"); }).find("(moov atom not found)"),
            std::string::npos);
}

TEST(FirstComplaint, IsOneLineThatIsTheSameEachTime) {
  EXPECT_EQ(first_complaint("", "v.mp4"), "");
  EXPECT_EQ(first_complaint("[h264 @ 0x5581f0] Invalid NAL unit size\nmore\n", "v.mp4"),
            "Invalid NAL unit size");
  EXPECT_EQ(first_complaint("a\tb\x1b[1m\xff", "v.mp4"), "a?b?[1m?");
  EXPECT_EQ(first_complaint("file:v.mp4: is wrong", "v.mp4"), "is wrong");
  EXPECT_EQ(first_complaint("[no end", "v.mp4"), "[no end");
  EXPECT_EQ(first_complaint(std::string(500, 'x'), "v.mp4").size(), 120U);
}

}  // namespace
}  // namespace stdc
