#include "slam/settings_io.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace stdc {
namespace {

std::string error_of(const std::string& yaml) {
  Settings settings;
  try {
    parse_settings(yaml, "s.yaml", settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SettingsIo, WrittenSettingsReadBackTheSame) {
  Settings settings;
  settings.features.keypoints = 777;
  settings.features.selection = Selection::orb_slam3;
  settings.noise.inverse_depth_sigma = 0.0123456789;
  Settings read;
  parse_settings(format_settings(settings), "s.yaml", read);
  EXPECT_EQ(format_settings(read), format_settings(settings));
  EXPECT_EQ(read.features.keypoints, 777);
}

TEST(SettingsIo, NamesFileLineAndNearestSetting) {
  const std::string error = error_of("features:\n  keypoint: 500\n");
  EXPECT_NE(error.find("s.yaml:2"), std::string::npos) << error;
  EXPECT_NE(error.find("did you mean 'features.keypoints'"), std::string::npos) << error;
}

TEST(SettingsIo, RefusesWrongValues) {
  EXPECT_NE(error_of("features: {keypoints: many}").find("'many' is no value"), std::string::npos);
  EXPECT_NE(error_of("features: {keypoints: 7}").find("outside 50..20000"), std::string::npos);
  EXPECT_NE(error_of("features: {scale_factor: nan}").find("is no value"), std::string::npos);
  EXPECT_NE(error_of("features: {selection: best}").find("improved|orb-slam3"), std::string::npos);
  EXPECT_NE(error_of("featurse: {keypoints: 700}").find("unknown setting"), std::string::npos);
  EXPECT_NE(error_of("features: [1, 2]").find("key: value"), std::string::npos);
  EXPECT_NE(error_of("features: {keypoints: 700").find("not valid YAML"), std::string::npos);
  EXPECT_NE(error_of("- 1\n- 2\n").find("not a YAML file of sections"), std::string::npos);
  EXPECT_NE(
      error_of("features: {keypoints: 700, keypoints: 800}").find("'features.keypoints' is given twice"),
      std::string::npos);
  EXPECT_NE(
      error_of("noise: {pixel_sigma: 1}\nnoise: {pixel_sigma: 2}").find("s.yaml:2: 'noise' is given twice"),
      std::string::npos);
  for (const char* nothing : {"", "# only a comment\n", "---\n"}) {
    EXPECT_NE(error_of(nothing).find("s.yaml: holds no settings"), std::string::npos) << nothing;
  }
}

TEST(SettingsIo, AFaultLeavesTheSettingsAsTheyWere) {
  Settings settings;
  EXPECT_THROW(parse_settings("features: {keypoints: 700, levels: 99}", "s.yaml", settings), Error);
  EXPECT_EQ(settings.features.keypoints, Settings().features.keypoints);
}

TEST(SettingsIo, AppliesAssignments) {
  Settings settings;
  apply_setting("features.keypoints=1500", settings);
  apply_setting("system.report_keypoints=on", settings);
  EXPECT_EQ(settings.features.keypoints, 1500);
  EXPECT_TRUE(settings.system.report_keypoints);
  EXPECT_THROW(apply_setting("features.keypoints", settings), Error);
  EXPECT_THROW(apply_setting("features.keypoints=", settings), Error);
  EXPECT_THROW(apply_setting("keypoints=4", settings), Error);
}

}  // namespace
}  // namespace stdc
