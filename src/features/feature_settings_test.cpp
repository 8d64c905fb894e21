#include "features/feature_settings.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

TEST(FeatureSettings, DefaultsAreValid) { EXPECT_NO_THROW(FeatureSettings().validate()); }

TEST(FeatureSettings, NamesTheSettingAtFault) {
  const auto where = [](const FeatureSettings& settings) -> std::string {
    try {
      settings.validate();
    } catch (const Error& error) {
      return error.where();
    }
    return "";
  };
  EXPECT_EQ(where({.keypoints = 3}), "features.keypoints");
  EXPECT_EQ(where({.scale_factor = 1.0}), "features.scale_factor");
  EXPECT_EQ(where({.levels = -1}), "features.levels");
  EXPECT_EQ(where({.threshold_low = 0}), "features.threshold_low");
  EXPECT_EQ(where({.threshold_high = 10, .threshold_low = 11}), "features.threshold_low");
  EXPECT_EQ(where({.threshold_high = 10, .threshold_low = 10}), "");
}

}  // namespace
}  // namespace stdc
