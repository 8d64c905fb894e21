// Phones' recordings with a video for colour, as a user sees them.
#include "commands/test_command_line.hpp"
#include "input/video/test_video.hpp"

namespace stdc::app {
namespace {

class VideoCommandLine : public CommandLine {
 protected:
  void SetUp() override {
    if (!stdc::test::has_ffmpeg()) GTEST_SKIP() << stdc::test::kNeedsFfmpeg;
  }

  /// The test sequence, and "phone", the same as Stray Scanner records it but for the unit and the size of
  /// depth.
  void make_phone(int frames, const std::vector<std::string>& codec) const {
    make_sequence(frames);
    std::string odometry = "timestamp, frame, x, y, z, qx, qy, qz, qw\n";
    std::vector<cv::Mat> images;
    fs::create_directories(folder_ / "phone/depth");
    for (int i = 0; i < frames; ++i) {
      const std::string png = content(folder_ / fmt::format("s/rgb/{}.png", i));
      const Bytes bytes(reinterpret_cast<const std::uint8_t*>(png.data()), png.size());
      images.push_back(decode_colour(bytes, {320, 240}, ColourMode::as_stored).image);
      fs::copy_file(folder_ / fmt::format("s/depth/{}.png", i),
                    folder_ / fmt::format("phone/depth/{:06d}.png", i));
      odometry += fmt::format("{:.6f}, {:06d}, {:.6f}, 0, 0, 0, 0, 0, 1\n", 100 + i / 30.0, i, 0.01 * i);
    }
    folder_.write("phone/odometry.csv", odometry);
    folder_.write("phone/camera_matrix.csv", std::string("300, 0, 159.5\n0, 300, 119.5\n0, 0, 1\n"));
    folder_.write("phone/camera.yaml", content(folder_ / "s/camera.yaml"));
    stdc::test::write_video(folder_ / "phone/rgb.mp4", images, codec);
  }
  static std::vector<std::string> lossless() { return {"-c:v", "libx264rgb", "-crf", "0"}; }

  std::string trajectory_of(const std::string& input, const std::string& frames = ":12") const {
    const std::string output = fmt::format("of-{}-{}", input, frames);
    const Outcome run = call(fmt::format("run {} --output {} --frames {} --segmentation off --motion off -q",
                                         input, output, frames));
    EXPECT_EQ(run.code, 0) << run.err;
    return content(folder_ / (output + "/trajectory.txt"));
  }
};

TEST_F(VideoCommandLine, RunsLikeTheSameImages) {
  make_phone(12, lossless());
  const std::string of_images = trajectory_of("s");
  EXPECT_EQ(lines(of_images), 12);
  EXPECT_EQ(trajectory_of("phone"), of_images);
  EXPECT_EQ(trajectory_of("phone", "4:9"), trajectory_of("s", "4:9"));
  EXPECT_EQ(call("convert phone --output phone-tum -q").code, 0);
  EXPECT_EQ(trajectory_of("phone-tum"), of_images);
}

TEST_F(VideoCommandLine, InfoTellsOfTheVideo) {
  make_phone(12, stdc::test::kLikePhones);
  const Outcome info = call("info phone");
  EXPECT_EQ(info.code, 0) << info.err;
  for (const char* part :
       {"kind         stray-scanner", "rgb.mp4: colour images, 12", "frames       12 in 0.37 s",
        "colour 320 x 240", "poses that ARKit found, no ground truth"}) {
    EXPECT_TRUE(contains(info.out, part)) << part << "\n" << info.out;
  }
  EXPECT_FALSE(contains(info.out, "warning")) << info.out;
}

TEST_F(VideoCommandLine, OtherCommandsTakeIt) {
  make_phone(12, stdc::test::kLikePhones);
  const Outcome features = call("features phone --frames 3,1 --quiet");
  EXPECT_EQ(features.code, 0) << features.err;
  EXPECT_LT(features.out.find("        3"), features.out.find("        1")) << features.out;
  const Outcome mcap = call("convert phone --output p.mcap -q");
  EXPECT_EQ(mcap.code, 0) << mcap.err;
  EXPECT_TRUE(contains(call("info p.mcap").out, "frames       12 in"));
}

TEST_F(VideoCommandLine, UsesADamagedVideoUpToTheDamage) {
  make_phone(40, stdc::test::kLikePhones);
  stdc::test::cut_file(folder_ / "phone/rgb.mp4", 0.7);
  const Outcome run = call("run phone --output o --segmentation off --motion off -q");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(contains(run.err, "phone/rgb.mp4: cannot be decoded from frame ")) << run.err;
  EXPECT_TRUE(contains(run.err, "but odometry.csv 40 lines")) << run.err;
  EXPECT_FALSE(contains(run.err, "--frames")) << run.err;
  const long poses = lines(content(folder_ / "o/trajectory.txt"));
  EXPECT_GT(poses, 3);
  EXPECT_LT(poses, 40);
  const Outcome info = call("info phone");
  EXPECT_EQ(info.code, 0) << info.err;
  EXPECT_TRUE(contains(info.out, "warning      phone/rgb.mp4: cannot be decoded from frame ")) << info.out;
}

TEST_F(VideoCommandLine, SaysWhatIsWrong) {
  make_phone(4, stdc::test::kLikePhones);
  const Outcome without = call("--version && PATH=/nonexistent " STDC_PROGRAM " run phone --output o");
  EXPECT_EQ(without.code, 2);
  EXPECT_TRUE(contains(without.err,
                       "phone/rgb.mp4: is a video, and the program ffmpeg, which decodes videos, is "
                       "not installed; apt install ffmpeg"))
      << without.err;
  EXPECT_FALSE(fs::exists(folder_ / "o"));
  folder_.write("phone/rgb.mp4", std::string("ftyp"));
  expect_refusal("run phone --output o", "phone/rgb.mp4: holds no video that ffmpeg can read (");
  fs::remove(folder_ / "phone/rgb.mp4");
  expect_refusal("run phone --output o", "phone/rgb.mp4: there is no such file");
}

}  // namespace
}  // namespace stdc::app
