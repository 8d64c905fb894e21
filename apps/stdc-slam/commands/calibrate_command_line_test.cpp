#include "commands/test_command_line.hpp"

namespace stdc::app {
namespace {

using CalibrateCommandLine = CommandLine;

/// A wall of one distance, past which the camera moves evenly: its scale shows by the truth, and no delay.
TEST_F(CalibrateCommandLine, SaysWhatARecordingDoesNotShow) {
  make_sequence(40);
  std::string camera = content(folder_ / "s/camera.yaml");
  const auto at = camera.find("depth_units_per_metre: 5000");
  ASSERT_NE(at, std::string::npos);
  camera.replace(at, std::string("depth_units_per_metre: 5000").size(), "depth_units_per_metre: 5150");
  folder_.write("wrong.yaml", camera);
  const Outcome outcome = call("calibrate s --camera wrong.yaml --output o.yaml --quiet");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "depth_time_offset      not seen")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "depth_units_per_metre")) << outcome.out;
  const std::string found = content(folder_ / "o.yaml");
  EXPECT_TRUE(contains(found, "depth_time_offset: not seen")) << found;
  const auto units = found.find("\ndepth_units_per_metre: ");
  ASSERT_NE(units, std::string::npos) << found;
  EXPECT_NEAR(std::stod(found.substr(units + std::string("\ndepth_units_per_metre: ").size())), 5000, 15);
  const Outcome run = call("run s --camera o.yaml --output r --quiet --no-report --segmentation off");
  EXPECT_EQ(run.code, 0) << run.err;
}

TEST_F(CalibrateCommandLine, RefusesWhatTellsNothing) {
  make_sequence(3);
  expect_refusal("calibrate s --quiet --output o", "too few to tell anything");
  expect_refusal("calibrate nowhere --output o", "nowhere");
  expect_refusal("calibrate s --distance 0 --output o", "--distance");
  expect_refusal("calibrate openni2: --camera s/camera.yaml --output o", "openni2:: is a live camera");
}

}  // namespace
}  // namespace stdc::app
