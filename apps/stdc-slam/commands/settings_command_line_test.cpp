// Settings as the program takes them: names of earlier versions and double entries are refused.
#include "commands/test_command_line.hpp"

namespace stdc::app {
namespace {

class SettingsCommandLine : public CommandLine {};

TEST_F(SettingsCommandLine, AnOldNameIsRefusedWithTheNewOne) {
  expect_refusal("settings --set tracking.match_distance=50",
                 "'tracking.match_distance' is now called 'tracking.max_hamming_distance'");
  folder_.write("old.yaml", std::string("mapping:\n  neighbours: 5\n  minimum_parallax: 2\n"));
  expect_refusal("settings --settings old.yaml",
                 "old.yaml:3: setting 'mapping.minimum_parallax' is now called 'mapping.min_parallax'");
  expect_refusal("run s --output o --settings old.yaml", "mapping.min_parallax");
}

TEST_F(SettingsCommandLine, ASettingGivenTwiceIsRefused) {
  folder_.write("twice.yaml", std::string("features:\n  keypoints: 500\n  keypoints: 900\n"));
  expect_refusal("settings --settings twice.yaml", "twice.yaml:3: 'features.keypoints' is given twice");
}

}  // namespace
}  // namespace stdc::app
