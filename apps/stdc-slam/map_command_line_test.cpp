// Map files as a user meets them.
#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace stdc::app
