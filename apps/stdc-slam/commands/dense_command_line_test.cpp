// The dense map as a user meets it: run --dense, map export.
#include <nlohmann/json.hpp>

#include "commands/test_command_line.hpp"

namespace stdc::app {
namespace {

constexpr const char* kRun = "run s -o first --segmentation off --motion off --dense-voxel 0.04 ";

class DenseCommandLine : public CommandLine {
 protected:
  /// "s.map": a map with a dense part.
  void make_map() const {
    make_sequence();
    const Outcome outcome = call(std::string(kRun) + "--dense a.ply --save-map s.map");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  /// Nothing of an unfinished file is left.
  void expect_no_partial_files() const {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path())) {
      EXPECT_FALSE(contains(entry.path().filename().string(), ".partial")) << entry.path();
    }
  }
};

TEST_F(DenseCommandLine, ARunWritesWhatIsAskedForAndTheSameBytesAgain) {
  make_sequence();
  const Outcome outcome = call(std::string(kRun) + "--dense a.glb --dense a.ply --dense a.pcd");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "\ndense map: a.glb, a.ply, a.pcd (")) << outcome.out;
  EXPECT_TRUE(content(folder_ / "a.glb").starts_with("glTF"));
  EXPECT_TRUE(content(folder_ / "a.ply").starts_with("ply\n"));
  EXPECT_TRUE(content(folder_ / "a.pcd").starts_with("# .PCD v0.7"));
  const auto summary = nlohmann::json::parse(content(folder_ / "first/summary.json"));
  EXPECT_EQ(summary["dense"]["files"], "a.glb, a.ply, a.pcd");
  EXPECT_GT(summary["dense"]["triangles"], 100);
  EXPECT_EQ(summary["dense"]["voxel_m"], 0.04);
  const std::string trajectory = content(folder_ / "first/trajectory.txt");
  ASSERT_EQ(call(std::string(kRun) + "--dense b.ply --quiet").code, 0);
  EXPECT_EQ(content(folder_ / "a.ply"), content(folder_ / "b.ply"));
  ASSERT_EQ(call("run s -o first --segmentation off --motion off").code, 0);
  EXPECT_EQ(content(folder_ / "first/trajectory.txt"), trajectory);
  expect_no_partial_files();
}

/// Images of the sequence "s" in colours, as JPEG, which stores the brightness apart.
void make_jpeg(const TestFolder& folder) {
  std::string list = content(folder / "s/rgb.txt");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "s/rgb")) {
    const std::string png = content(entry.path());
    const cv::Mat grey = decode_png_colour({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()},
                                           {320, 240}, ColourMode::grey)
                             .image;
    cv::Mat coloured;
    cv::merge(std::vector<cv::Mat>{255 - grey, grey, 0.6 * grey}, coloured);
    folder.write("s/rgb/" + entry.path().stem().string() + ".jpg", encode_jpeg(coloured));
  }
  for (std::size_t at = list.find(".png"); at != std::string::npos; at = list.find(".png"))
    list.replace(at, 4, ".jpg");
  folder.write("s/rgb.txt", list);
}

TEST_F(DenseCommandLine, TheTrackerSeesTheSameGreyWhetherColourIsReadOrNot) {
  make_sequence();
  make_jpeg(folder_);
  ASSERT_EQ(call("run s -o grey --segmentation off --motion off --quiet").code, 0);
  ASSERT_EQ(call(std::string(kRun) + "--dense a.ply --quiet").code, 0);
  EXPECT_EQ(content(folder_ / "first/trajectory.txt"), content(folder_ / "grey/trajectory.txt"));
}

TEST_F(DenseCommandLine, AMapFileKeepsItsDensePart) {
  make_map();
  const auto info = nlohmann::json::parse(call("map info s.map --json").out);
  EXPECT_GE(info["dense_views"], 1);
  EXPECT_TRUE(contains(call("map info s.map").out, "\ndense part: ")) << call("map info s.map").out;
  const Outcome outcome = call("map export s.map --mesh b.ply --cloud c.ply --voxel 0.04");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(content(folder_ / "a.ply"), content(folder_ / "b.ply"));
  EXPECT_TRUE(contains(content(folder_ / "c.ply").substr(0, 400), "element vertex"));
  // A session without --dense neither adds to it nor drops it.
  ASSERT_EQ(call("run s -o first --load-map s.map --save-map t.map --quiet").code, 0);
  ASSERT_EQ(call("map export t.map --mesh d.ply --voxel 0.04 --quiet").code, 0);
  EXPECT_GT(fs::file_size(folder_ / "d.ply"), 10000U);
}

TEST_F(DenseCommandLine, MeshesAreSimplifiedAndNothingElseIs) {
  make_map();
  ASSERT_EQ(call("map export s.map --mesh whole.ply --cloud whole.pcd --voxel 0.04").code, 0);
  const Outcome outcome = call(
      "map export s.map --mesh few.ply --cloud few.pcd --voxel 0.04 --tolerance 0.02 --set "
      "dense.mesh_colour_tolerance=255");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, " triangles left of ")) << outcome.out;
  EXPECT_LT(fs::file_size(folder_ / "few.ply"), fs::file_size(folder_ / "whole.ply") / 4);
  EXPECT_EQ(content(folder_ / "few.pcd"), content(folder_ / "whole.pcd"));
  ASSERT_EQ(call(std::string(kRun) +
                 "--dense b.ply --dense-tolerance 0.02 --set dense.mesh_colour_tolerance=255 --quiet")
                .code,
            0);
  EXPECT_EQ(content(folder_ / "few.ply"), content(folder_ / "b.ply"));
  ASSERT_EQ(call("map export s.map --mesh c.ply --voxel 0.04 --triangles 200 --quiet").code, 0);
  EXPECT_TRUE(contains(content(folder_ / "c.ply").substr(0, 400), "element face 200\n") ||
              contains(content(folder_ / "c.ply").substr(0, 400), "element face 199\n"));
}

TEST_F(DenseCommandLine, RefusesInOneLineAndWritesNothing) {
  make_map();
  expect_refusal("run s -o o --dense mesh.stl", "give a file that ends in .glb, .ply, .pcd");
  expect_refusal("run s -o o --dense mesh", "the name has no ending");
  expect_refusal("run s -o o --dense none/mesh.glb", "none/mesh.glb: cannot be written");
  expect_refusal("run s -o o --dense m.glb --dense m.glb", "m.glb: is asked for twice");
  expect_refusal("run s -o o --dense-voxel 0.02", "--dense-voxel: there is no dense map to make");
  expect_refusal("run s -o o --dense m.glb --dense-voxel 5", "dense.voxel");
  expect_refusal("run s -o o --set dense.active=true", "dense.active: nothing is made of the dense map");
  expect_refusal("run s -o o --dense m.glb --load-map s.map --localisation-only",
                 "--dense: with --localisation-only");
  expect_refusal("run s -o o --dense-tolerance 0.01", "--dense-tolerance: there is no mesh to simplify");
  expect_refusal("run s -o o --dense m.pcd --dense-triangles 9",
                 "--dense-triangles: there is no mesh to simplify");
  expect_refusal("run s -o o --dense m.glb --dense-tolerance -1", "dense.mesh_tolerance");
  expect_refusal("map export s.map --cloud m.ply --tolerance 0.01",
                 "--tolerance: there is no mesh to simplify");
  expect_refusal("map export s.map --mesh m.ply --tolerance 0.01 --set dense.mesh_tolerance=0.1",
                 "--tolerance: is the same setting as");
  expect_refusal("map export s.map", "nothing is to be written");
  expect_refusal("map export s.map --mesh m.pcd", "--mesh m.pcd: '.pcd' is no ending");
  expect_refusal("map export s.map --cloud m.glb", "--cloud m.glb");
  expect_refusal("map export s.map --mesh m.glb --map 3", "s.map: has no map 3");
  expect_refusal("map export s.map --grid m.yaml --up 1,2", "--up: '1,2' is no direction");
  expect_refusal("map export s.map --output o --voxel 0.1", "about the dense map, which is not asked for");
  expect_refusal("map export s.map --grid m.yaml --voxel 0.04", "m.yaml: no floor was found");  // a wall
  expect_refusal("map export s.map --mesh m.glb --set dense.min_component=50",
                 "m.glb: there is no surface to write");
  ASSERT_EQ(call("run s -o first --save-map plain.map --quiet").code, 0);
  expect_refusal("map export plain.map --mesh m.glb", "plain.map: has no dense part");
  EXPECT_FALSE(fs::exists(folder_ / "m.glb"));
  expect_no_partial_files();
}

TEST_F(DenseCommandLine, ADiskThatIsFullLeavesWhatWasThere) {
  make_map();
  folder_.write("small.ply", std::string("old"));
  // A limit on the size of files stands for the disk.
  const Outcome outcome = call("map info s.map > /dev/null; ulimit -f 8; trap '' XFSZ; " STDC_PROGRAM
                               " map export s.map --mesh small.ply --voxel 0.04");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "small.ply: cannot be written")) << outcome.err;
  EXPECT_EQ(content(folder_ / "small.ply"), "old");
  expect_no_partial_files();
}

TEST_F(DenseCommandLine, ADiskThatIsFullAtTheEndOfARunLeavesNothingHalf) {
  make_sequence();
  folder_.write("a.ply", std::string("old"));
  const Outcome outcome = call("--version > /dev/null; ulimit -f 8; trap '' XFSZ; " STDC_PROGRAM " " +
                               std::string(kRun) + "--dense a.ply --quiet");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.err, "a.ply: cannot be written")) << outcome.err;
  EXPECT_EQ(content(folder_ / "a.ply"), "old");
  EXPECT_FALSE(fs::exists(folder_ / "first"));
  expect_no_partial_files();
}

}  // namespace
}  // namespace stdc::app
