// Cameras of OpenNI 2: a driver of the tests' own (tools/openni_film) plays rendered frames through Debian's
// unmodified library. Frames may be dropped on a slow machine: then they are counted.
#include <cmath>
#include <cstring>

#include "commands/test_command_line.hpp"
#include "input/frame_decoder.hpp"
#include "input/open_source.hpp"

namespace stdc::app {
namespace {

/// A line of progress comes every five seconds.
constexpr const char* kUntilItTracks =
    "i=0; while [ $i -lt 600 ] && ! grep -q tracking: log; do sleep 0.1; i=$((i+1)); done\n";

class OpenNiCommandLine : public CommandLine {
 protected:
  void SetUp() override {
#ifndef STDC_OPENNI_CAMERA
    GTEST_SKIP() << "needs libopenni2-dev: scripts/packages-optional.txt";
#endif
  }

  /// Makes the test sequence a film, with depth in millimetres, and its camera file "c.yaml".
  void make_film(int frames, int period_ms) const {
    make_sequence(frames);
    const auto source = open_source(folder_ / "s");
    Camera camera = source->cameras()->colour;
    const FrameDecoder decoder(*source->cameras());
    const std::int32_t head[] = {camera.width, camera.height, frames, period_ms};
    std::string film(reinterpret_cast<const char*>(head), sizeof(head));
    while (const auto packed = source->next()) {
      const RgbdImage image = decoder.decode(*packed, ColourMode::as_stored);
      cv::Mat colour, depth;
      cv::cvtColor(image.colour, colour, cv::COLOR_BGR2RGB);
      image.depth.convertTo(depth, CV_16U, 1000 / camera.depth_units_per_metre);
      film.append(reinterpret_cast<const char*>(colour.data), colour.total() * 3);
      film.append(reinterpret_cast<const char*>(depth.data), depth.total() * 2);
    }
    folder_.write("film", film);
    camera.depth_units_per_metre = 1000;
    folder_.write("c.yaml", format_camera(camera));
  }
  Outcome with_camera(const std::string& script) const {
#ifdef STDC_OPENNI_CAMERA
    const char* camera = STDC_OPENNI_CAMERA;
#else
    const char* camera = "";
#endif
    folder_.write("script", fmt::format("export STDC_FILM=film LD_LIBRARY_PATH={} SLAM={}\n{}", camera,
                                        STDC_PROGRAM, script));
    const int status =
        std::system(fmt::format("cd {} && sh ./script > .out 2> .err", folder_.path().string()).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(folder_ / ".out"),
            content(folder_ / ".err")};
  }
};

TEST_F(OpenNiCommandLine, RecordingHoldsWhatTheCameraShowed) {
  make_film(12, 150);
  const Outcome outcome = with_camera("$SLAM record openni2: --camera c.yaml --output r --frames :10");
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  ASSERT_TRUE(contains(outcome.out, "10 frames")) << outcome.out;
  // Frame i of the film has the time (i + 1) * 33.333 ms, so each recorded frame says which it is.
  const auto recorded = open_source(folder_ / "r"), original = open_source(folder_ / "s");
  const FrameDecoder recorded_images(*recorded->cameras()), original_images(*original->cameras());
  std::vector<RgbdImage> originals;
  while (const auto frame = original->next())
    originals.push_back(original_images.decode(*frame, ColourMode::as_stored));
  int compared = 0;
  while (const auto frame = recorded->next()) {
    const RgbdImage image = recorded_images.decode(*frame, ColourMode::as_stored);
    const auto index =
        static_cast<std::size_t>(std::lround(frame->timestamp / 0.033333) - 1) % originals.size();
    EXPECT_EQ(std::memcmp(image.colour.data, originals[index].colour.data, image.colour.total() * 3), 0)
        << index;
    EXPECT_EQ(image.depth.at<std::uint16_t>(100, 100), 2000);
    ++compared;
  }
  EXPECT_EQ(compared, 10);
}

TEST_F(OpenNiCommandLine, RunsUntilItIsInterruptedAndWritesEverything) {
  make_film(12, 100);
  const Outcome outcome = with_camera(
      "$SLAM run openni2:film --camera c.yaml --output o --segmentation off --motion off 2> log & slam=$!\n" +
      std::string(kUntilItTracks) + "kill -INT $slam; wait $slam");
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_GT(lines(content(folder_ / "o/trajectory.txt")), 1);
  EXPECT_TRUE(fs::exists(folder_ / "o/summary.json"));
}

TEST_F(OpenNiCommandLine, AnImpatientFilmIsDroppedAndReported) {
  make_film(60, 1);
  const Outcome outcome = with_camera(
      "$SLAM run openni2: --camera c.yaml --output o --segmentation off --motion off 2> log & slam=$!\n" +
      std::string(kUntilItTracks) + "kill -TERM $slam; wait $slam");
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(contains(content(folder_ / "log"), "frames came too late and are left out"));
}

TEST_F(OpenNiCommandLine, SaysWhatIsMissing) {
  make_film(2, 10);
  const Outcome no_camera = with_camera("$SLAM run openni2: --output o");
  EXPECT_EQ(no_camera.code, 2);
  EXPECT_TRUE(contains(no_camera.err, "OpenNI has no intrinsics")) << no_camera.err;
  const Outcome other = with_camera("$SLAM run openni2:kinect --camera c.yaml --output o");
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(contains(other.err, "there is no such camera; give one of openni2:film")) << other.err;
  const Outcome inpaint = with_camera("$SLAM run openni2: --camera c.yaml --output o --inpaint i");
  EXPECT_EQ(inpaint.code, 2);
  EXPECT_TRUE(contains(inpaint.err, "stdc-slam record")) << inpaint.err;
  const Outcome topics =
      with_camera("$SLAM record openni2: --camera c.yaml --color /camera/color --output r");
  EXPECT_EQ(topics.code, 2);
  EXPECT_TRUE(contains(topics.err, "openni2: has no topics")) << topics.err;
  const Outcome folder = with_camera("$SLAM record s --output r");
  EXPECT_EQ(folder.code, 2);
  EXPECT_TRUE(contains(folder.err, "is no live camera")) << folder.err;
  EXPECT_FALSE(fs::exists(folder_ / "o"));
}

}  // namespace
}  // namespace stdc::app
