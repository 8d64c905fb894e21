// Map files as a user meets them.
#include <nlohmann/json.hpp>

#include "datasets/trajectory.hpp"
#include "map/test_map_file.hpp"
#include "test_command_line.hpp"

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
    save_map(folder_ / "a.map", mapped.scene.camera, mapped.map);
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
