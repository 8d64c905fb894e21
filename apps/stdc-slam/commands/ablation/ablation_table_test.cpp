#include "commands/ablation/ablation_table.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stdc::app {
namespace {

AblationTable example() {
  return {{"OS3", "OS3+S"},
          {{"walking-xyz", {{std::nullopt, 0.125, 5.5}, {0.0123, 1, 6.25}}},
           {"static-desk", {{0.004, 1, 5}, {0.00409, 0.5, 6}}}}};
}

TEST(AblationTable, ShowsCoverageBesideEveryError) {
  const std::string text = format_text(example());
  EXPECT_NE(text.find("- (12.5 %)  0.0123 (100.0 %)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("0.0041 (50.0 %)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("walking-xyz  5.50   6.25\n"), std::string::npos) << text;
}

TEST(AblationTable, MarkdownHasALineUnderTheHead) {
  const std::string text = format_markdown(example());
  EXPECT_NE(text.find("| Sequence | OS3 | OS3+S |\n|---|---:|---:|\n| walking-xyz | - (12.5 %) |"),
            std::string::npos)
      << text;
}

TEST(AblationTable, JsonSaysWhatHasNoScore) {
  const auto json = nlohmann::json::parse(format_json(example()));
  EXPECT_TRUE(json["walking-xyz"]["OS3"]["ate_rmse_m"].is_null());
  EXPECT_EQ(json["static-desk"]["OS3"]["ate_rmse_m"], 0.004);
  EXPECT_EQ(json["walking-xyz"]["OS3+S"]["frame_ms"], 6.25);
}

}  // namespace
}  // namespace stdc::app
