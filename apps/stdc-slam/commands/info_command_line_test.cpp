// info and convert as a user sees them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/test_command_line.hpp"

namespace stdc::app {
namespace {

class InfoCommandLine : public CommandLine {
 protected:
  void change_camera(const std::string& from, const std::string& to) const {
    std::string camera = content(folder_ / "s/camera.yaml");
    camera.replace(camera.find(from), from.size(), to);
    folder_.write("s/camera.yaml", camera);
  }
};

TEST_F(InfoCommandLine, TellsWhatAnInputIs) {
  make_sequence();
  const Outcome outcome = call("info s");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* part :
       {"kind         tum", "frames       12 in 0.37 s: 30.0 a second", "gaps         none",
        "depth time   +3.0 ms from colour", "colour 320 x 240, depth 320 x 240 (16 bits)",
        "100 % of the pixels have one, median 2 m", "fx 300.00", "ground truth 12 poses",
        "IMU          none"}) {
    EXPECT_TRUE(contains(outcome.out, part)) << part << "\n" << outcome.out;
  }
  EXPECT_FALSE(contains(outcome.out, "warning")) << outcome.out;
}

TEST_F(InfoCommandLine, WarnsOfTheUnitOfDepth) {
  make_sequence();
  change_camera("depth_units_per_metre: 5000", "depth_units_per_metre: 50000");
  const Outcome outcome = call("info s --json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["kind"], "tum");
  EXPECT_EQ(json["frames"], 12);
  EXPECT_NEAR(json["images"]["median_depth_m"], 0.2, 1e-6);
  EXPECT_EQ(json["camera"]["fx"], 300);
  ASSERT_EQ(json["warnings"].size(), 1U) << json["warnings"];
  EXPECT_TRUE(contains(json["warnings"][0],
                       "median depth is 0.20 m: is depth_units_per_metre 50000 where the device "
                       "writes 5000?"))
      << json["warnings"];
}

TEST_F(InfoCommandLine, WarnsOfACameraOfAnotherSizeAndOfNone) {
  make_sequence();
  change_camera("width: 320", "width: 640");
  EXPECT_TRUE(contains(call("info s").out, "the images have 320 x 240 pixels, but the camera has 640 x 240"));
  fs::remove(folder_ / "s/camera.yaml");
  const Outcome unknown = call("info s");
  EXPECT_EQ(unknown.code, 0) << unknown.err;
  EXPECT_TRUE(contains(unknown.out, "camera       not known")) << unknown.out;
  EXPECT_TRUE(contains(unknown.out, "median 1e+04 units")) << unknown.out;
  EXPECT_TRUE(contains(unknown.out, "warning      the camera is not known: put a camera.yaml"))
      << unknown.out;
}

TEST_F(InfoCommandLine, PairsFramesByTheDelayThatTheCameraFileTells) {
  make_sequence();  // depth images are stamped 3 ms later than colour
  folder_.write("s/camera.yaml", content(folder_ / "s/camera.yaml") + "depth_time_offset: 0.032\n");
  const Outcome outcome = call("info s");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  // So each colour image takes the depth image before its own, which was taken 1.7 ms later; the first has
  // none.
  EXPECT_TRUE(contains(outcome.out, "depth time   +1.7 ms from colour")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "; with the camera's depth_time_offset of +32.0 ms")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "frames       11 in ")) << outcome.out;
  EXPECT_EQ(nlohmann::json::parse(call("info s --json").out)["camera"]["depth_time_offset"], 0.032);
}

TEST_F(InfoCommandLine, RefusesWhatIsNoInput) {
  folder_.write("a.xyz", std::string("?"));
  expect_refusal("info a.xyz", "a.xyz: is no recording of a kind that can be read");
  folder_.write("a.R3D", std::string("PK"));
  expect_refusal("info a.R3D", "a.R3D: is a recording of Record3D, whose depth is packed by LZFSE");
  folder_.write("unzipped/rgbd/0.depth", std::string("bvx2"));
  folder_.write("unzipped/metadata", std::string("{}"));
  expect_refusal("info unzipped", "unzipped: is a recording of Record3D");
  folder_.write("rgb.mp4", std::string("ftyp"));
  expect_refusal("info rgb.mp4", "rgb.mp4: is a video without depth images; give the folder that holds it");
  folder_.write("phone/video.MOV", std::string("ftyp"));
  folder_.write("phone/other.mp4", std::string("ftyp"));
  folder_.write("phone/depth/000000.png", std::string("?"));
  expect_refusal("info phone", "phone: holds several videos: other.mp4 and video.MOV; leave only");
  expect_refusal("info none", "none: there is no such folder");
  make_sequence(1);
  expect_refusal("info s --input-kind elephant",
                 "--input-kind: there is no kind 'elephant'; give one of openni2, tum");
  expect_refusal("info openni2:", "openni2:: is a live camera");
  expect_refusal("info s --input-kind openni2", "s: is a live camera");
  expect_refusal("info s --color /camera/color", "s: is of the kind tum, which has no topics");
}

TEST_F(InfoCommandLine, ConvertGivesTheSameSequence) {
  make_sequence();
  const Outcome outcome = call("convert s --output o -q");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  for (const char* folder : {"s", "o"}) {
    const Outcome run =
        call(fmt::format("run {0} --output of-{0} --segmentation off --motion off -q", folder));
    EXPECT_EQ(run.code, 0) << run.err;
  }
  EXPECT_EQ(content(folder_ / "of-s/trajectory.txt"), content(folder_ / "of-o/trajectory.txt"));
  EXPECT_GT(lines(content(folder_ / "of-o/trajectory.txt")), 10);
  EXPECT_EQ(content(folder_ / "o/groundtruth.txt"), content(folder_ / "s/groundtruth.txt"));
  const Outcome again = call("convert s --output o");
  EXPECT_EQ(again.code, 2);
  EXPECT_TRUE(contains(again.err, "o: the folder is not empty; choose another --output, or give --overwrite"))
      << again.err;
  EXPECT_EQ(call("convert s --output o --overwrite --frames 2:5 -q").code, 0);
  EXPECT_EQ(lines(content(folder_ / "o/rgb.txt")), 5) << "two lines of comments";
}

TEST_F(InfoCommandLine, ConvertRefusesItsOwnInput) {
  make_sequence(2);
  expect_refusal("convert s --output s --overwrite", "s: is the input itself");
  expect_refusal("convert s --output o --frames 1:9", "--frames: 1:9 is empty or goes beyond");
}

/// The same frames in other layouts give the same trajectory.
TEST_F(InfoCommandLine, RunTakesOtherLayouts) {
  make_sequence();
  fs::create_directories(folder_ / "open/color");
  fs::create_directories(folder_ / "open/depth");
  for (int i = 0; i < 12; ++i) {
    fs::copy_file(folder_ / fmt::format("s/rgb/{}.png", i), folder_ / fmt::format("open/color/{}.png", i));
    fs::copy_file(folder_ / fmt::format("s/depth/{}.png", i), folder_ / fmt::format("open/depth/{}.png", i));
  }
  fs::copy_file(folder_ / "s/camera.yaml", folder_ / "open/camera.yaml");
  const Outcome run = call("run open --output o --segmentation off --motion off -q");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(contains(run.err, "open: has no times: frame n is taken to be at n / 30 s")) << run.err;
  EXPECT_EQ(lines(content(folder_ / "o/trajectory.txt")), 12);
  const Outcome segment = call("features open --frames 3,1 --quiet");
  EXPECT_EQ(segment.code, 0) << segment.err;
  EXPECT_LT(segment.out.find("        3"), segment.out.find("        1")) << segment.out;
}

}  // namespace
}  // namespace stdc::app
