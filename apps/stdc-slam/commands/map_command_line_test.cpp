// Map files as a user meets them.
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "atlas/storage/test_map_file.hpp"
#include "commands/test_command_line.hpp"
#include "input/trajectory.hpp"

namespace stdc::app {
namespace {

class MapCommandLine : public CommandLine {
 protected:
  /// "a.map": two maps of three keyframes each.
  void make_map() const {
    stdc::test::MappedScene mapped(stdc::test::Scene(80));
    for (int k = 0; k < 6; ++k) {
      if (k == 3) mapped.start_map();
      mapped.add(mapped.scene.look(stdc::test::camera_at(0.05 * k, 0, 0)));
    }
    save_map(folder_ / "a.map", mapped.scene.camera, mapped.atlas);
  }
};

TEST_F(MapCommandLine, InfoTellsWhatIsThere) {
  make_map();
  const Outcome outcome = call("map info a.map");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "2 maps, 6 keyframes, ")) << outcome.out;
  const auto json = nlohmann::json::parse(call("map info a.map --json").out);
  EXPECT_EQ(json["bytes"], fs::file_size(folder_ / "a.map"));
  EXPECT_EQ(json["maps"].size(), 2U);
}

TEST_F(MapCommandLine, ExportWritesAllFiles) {
  make_map();
  const Outcome outcome = call("map export a.map --output o");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(content(folder_ / "o/points.ply").substr(0, 400), "\nend_header\n"));
  EXPECT_EQ(lines(content(folder_ / "o/keyframes.txt")), 3);
  EXPECT_EQ(lines(content(folder_ / "o/keyframes-map-1.txt")), 3);
  EXPECT_EQ(call("map export a.map --output o --quiet").out, "");
}

TEST_F(MapCommandLine, BadMapsAreRefused) {
  expect_refusal("map", "subcommand");
  expect_refusal("map info", "FILE");
  expect_refusal("map info none.map", "none.map: cannot be opened");
  folder_.write("photo.map", std::string("not a map at all"));
  expect_refusal("map info photo.map", "photo.map: is not a map file");
  expect_refusal("map export photo.map --output o", "photo.map: is not a map file");
  make_map();
  fs::resize_file(folder_ / "a.map", 5000);
  expect_refusal("map export a.map --output o", "a.map: is damaged (it ends too early)");
  expect_refusal("map export a.map", "--output");
  EXPECT_TRUE(contains(call("map --help").out, "Examples:"));
  EXPECT_TRUE(contains(call("map info --help").out, "Examples:"));
  EXPECT_TRUE(contains(call("map export --help").out, "Examples:"));
}

TEST_F(MapCommandLine, ARunLeavesAMapAndALaterOneIsFoundInIt) {
  make_sequence();
  const Outcome first = call("run s --output first --save-map first/s.map");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_TRUE(contains(first.out, "\nmap: first/s.map\n")) << first.out;
  const auto summary = nlohmann::json::parse(content(folder_ / "first/summary.json"));
  const auto map = nlohmann::json::parse(call("map info first/s.map --json").out);
  EXPECT_EQ(map["keyframes"], summary["keyframes"]);
  EXPECT_EQ(map["camera"]["fx"], 300.0);
  EXPECT_EQ(summary["maps"], 1);
  EXPECT_EQ(summary["loops"], 0);

  const std::string before = content(folder_ / "first/s.map");
  const Outcome later =
      call("run s --frames 3:12 --output later --load-map first/s.map --localisation-only --debug-images p");
  ASSERT_EQ(later.code, 0) << later.err;
  const auto found = nlohmann::json::parse(content(folder_ / "later/summary.json"));
  EXPECT_EQ(found["coverage"], 1.0);
  EXPECT_EQ(found["landmarks"], summary["landmarks"]) << "nothing is added";
  EXPECT_LT(found["scores"]["ate_m"]["rmse"], 0.005);
  EXPECT_EQ(content(folder_ / "later/keyframes.txt"), "");
  EXPECT_EQ(content(folder_ / "first/s.map"), before);
  // In the coordinates of the map: frame 3 is 3 cm from the first run's start.
  const Trajectory trajectory = read_trajectory(folder_ / "later/trajectory.txt");
  ASSERT_EQ(trajectory.size(), 9U);
  EXPECT_NEAR(trajectory.front().world_from_cam.translation.x(), 0.03, 0.003);
}

TEST_F(MapCommandLine, ASessionGoesOnWithAMapAndSavesItAgain) {
  make_sequence(12);
  ASSERT_EQ(call("run s --frames 0:6 --output first --save-map s.map --quiet").code, 0);
  const Outcome second = call("run s --frames 6:12 --output second --load-map s.map --save-map s.map");
  ASSERT_EQ(second.code, 0) << second.err;
  const auto map = nlohmann::json::parse(call("map info s.map --json").out);
  const auto summary = nlohmann::json::parse(content(folder_ / "second/summary.json"));
  EXPECT_EQ(map["keyframes"], summary["keyframes"]);
  EXPECT_EQ(map["maps"].size(), 1U) << "the second part was found in the map of the first";
  EXPECT_EQ(call("map export s.map --output points").code, 0);
}

TEST_F(MapCommandLine, MapsThatWereNotJoinedStandInFilesOfTheirOwn) {
  make_sequence(24);
  // From frame 9 on the camera sees another place: mirrored, no corner is what it was.
  for (int i = 9; i < 24; ++i) {
    const fs::path path = folder_ / fmt::format("s/rgb/{}.png", i);
    const std::string bytes = content(path);
    const std::vector<std::uint8_t> png(bytes.begin(), bytes.end());
    cv::Mat mirrored;
    cv::flip(decode_colour(png, {320, 240}, ColourMode::as_stored).image, mirrored, 1);
    folder_.write(fmt::format("s/rgb/{}.png", i), encode_png(mirrored, PngEffort::fast));
  }
  folder_.write("o/trajectory-map-7.txt", std::string("of an older run\n"));
  const std::string run =
      "run s --segmentation off --set tracking.new_map_after=3 --save-map s.map --output ";
  const Outcome outcome = call(run + "o");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(content(folder_ / "o/summary.json"));
  EXPECT_EQ(summary["maps"], 2);
  EXPECT_TRUE(contains(outcome.out, "\n2 maps that were not joined\n")) << outcome.out;
  const long most = lines(content(folder_ / "o/trajectory.txt"));
  EXPECT_EQ(lines(content(folder_ / "o/trajectory-map-0.txt")), 9);
  EXPECT_GT(most, 9);
  EXPECT_NEAR(summary["coverage"], static_cast<double>(most) / 24, 1e-9) << "of one map only";
  EXPECT_EQ(summary["frames"]["ok"], most + 9);
  EXPECT_TRUE(contains(outcome.out, ", 9 in other maps")) << outcome.out;
  EXPECT_FALSE(fs::exists(folder_ / "o/trajectory-map-7.txt"));
  EXPECT_TRUE(contains(content(folder_ / "o/frames.csv"), "\n8,100.266667,ok,0,"));
  EXPECT_TRUE(contains(content(folder_ / "o/frames.csv"), "\n10,100.333333,lost,,"));
  EXPECT_TRUE(contains(content(folder_ / "o/frames.csv"), "\n23,100.766667,ok,1,"));
  ASSERT_EQ(call("map export s.map --output points").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "points/keyframes-map-1.txt"));
}

TEST_F(MapCommandLine, RunRefusesMapsThatWillNotDo) {
  make_sequence(3);
  expect_refusal("run s --output o --localisation-only", "--localisation-only: there is no map");
  expect_refusal("run s --output o --set system.localisation_only=true",
                 "--localisation-only: there is no map");
  expect_refusal("run s --output o --load-map none.map", "none.map: cannot be opened");
  make_map();
  expect_refusal("run s --output o --load-map a.map", "a.map");  // made with another camera
  expect_refusal("run s --output o --load-map a.map --localisation-only --save-map b.map", "--save-map");
  expect_refusal("run s --output o --save-map no/folder/a.map", "no/folder/a.map: cannot be written");
  expect_refusal("run s --output o --save-map s", "s: is a folder");
  folder_.write("photo.map", std::string("not a map at all"));
  expect_refusal("run s --output o --load-map photo.map", "photo.map: is not a map file");
}

TEST_F(MapCommandLine, ARunThatFailsLeavesNoMap) {
  make_sequence(3);
  folder_.write("s/rgb/0.png", std::string("no image"));
  expect_refusal("run s --output o --save-map new.map", "s/rgb/0.png");
  EXPECT_FALSE(fs::exists(folder_ / "new.map"));
}

}  // namespace
}  // namespace stdc::app
