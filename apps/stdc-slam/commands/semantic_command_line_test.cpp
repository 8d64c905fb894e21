// Segmentation and ablation as a user meets them.
#include <nlohmann/json.hpp>

#include "commands/test_command_line.hpp"

namespace stdc::app {
namespace {

/// The sequence "s" with masks of its left third in s/mask.
class SemanticCommandLine : public CommandLine {
 protected:
  void make_masks(int frames) const {
    cv::Mat mask(240, 320, CV_8UC1, cv::Scalar(0));
    mask.colRange(0, 100) = 255;
    std::string list;
    for (int i = 0; i < frames; ++i) {
      folder_.write(fmt::format("s/mask/{}.png", i), encode_png(mask, PngEffort::fast));
      list += fmt::format("{:.6f} {}.png\n", 100 + i / 30.0, i);
    }
    folder_.write("s/mask/mask.txt", list);
  }
};

TEST_F(SemanticCommandLine, RunTakesMasksFromFiles) {
  make_sequence();
  make_masks(12);
  const Outcome outcome =
      call("run s --output o --segmentation masks --refinement off --debug-images p --debug-every 5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "masks 0 frames old (median), dynamic 31 % of the view")) << outcome.out;
  const auto summary = nlohmann::json::parse(content(folder_ / "o/summary.json"));
  EXPECT_EQ(summary["segmentation"]["segmented_frames"], 12);
  EXPECT_NEAR(summary["segmentation"]["dynamic_share"]["median"], 100 / 320.0, 1e-9);
  EXPECT_EQ(summary["settings"]["segmentation"]["source"], "masks");
  EXPECT_LT(summary["scores"]["ate_m"]["rmse"], 0.005);
  EXPECT_TRUE(contains(content(folder_ / "o/frames.csv"), ",dynamic_share,mask_age,segmentation_ms,"));
  EXPECT_TRUE(contains(content(folder_ / "o/frames.csv"), ",0.3125,0,"));
}

TEST_F(SemanticCommandLine, RunFindsMasksByTheNumberOfTheFrameAndSaysHowManyThereAre) {
  make_sequence();
  cv::Mat mask(240, 320, CV_8UC1, cv::Scalar(0));
  mask.colRange(0, 100) = 255;
  for (int i = 1; i <= 12; ++i) {
    if (i != 5) folder_.write(fmt::format("m/frame-{:06d}.png", i), encode_png(mask, PngEffort::fast));
  }
  const Outcome outcome = call("run s --output o --masks m --refinement off --quiet");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "m: 11 of 12 images have a mask, found by number, counted from 1"))
      << outcome.err;
  const auto summary = nlohmann::json::parse(content(folder_ / "o/summary.json"));
  EXPECT_EQ(summary["segmentation"]["segmented_frames"], 11);
}

TEST_F(SemanticCommandLine, ADamagedMaskCostsThatMaskOnly) {
  make_sequence();
  make_masks(12);
  fs::resize_file(folder_ / "s/mask/5.png", 60);
  const Outcome outcome = call("run s --output o --segmentation masks --quiet");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "5.png")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "frame 5 has no mask of its own")) << outcome.err;
  EXPECT_EQ(lines(content(folder_ / "o/trajectory.txt")), 12);
}

TEST_F(SemanticCommandLine, TheAsynchronousPaceGivesTheSameBytesAgain) {
  make_sequence();
  make_masks(12);
  const std::string run = "run s --segmentation masks --set segmentation.pace=asynchronous --quiet --output ";
  ASSERT_EQ(call(run + "o").code, 0);
  ASSERT_EQ(call(run + "o2").code, 0);
  EXPECT_EQ(content(folder_ / "o/trajectory.txt"), content(folder_ / "o2/trajectory.txt"));
  const auto summary = nlohmann::json::parse(content(folder_ / "o/summary.json"));
  EXPECT_EQ(summary["segmentation"]["mask_age_frames"]["median"], 3);
}

TEST_F(SemanticCommandLine, InRealTimeFramesComeAsTheCameraGivesThem) {
  make_sequence(4);
  const Outcome outcome = call("run s --output o --realtime --segmentation off");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "in real time: ")) << outcome.out;
  const auto summary = nlohmann::json::parse(content(folder_ / "o/summary.json"));
  EXPECT_GE(summary["processing_seconds"], 0.1);
  EXPECT_GT(summary["realtime_lag_ms"]["p99"], 0);
}

TEST_F(SemanticCommandLine, RunRefusesWhatGivesNoMasks) {
  make_sequence(3);
  expect_refusal("run s --output o --segmentation masks", "mask");
  expect_refusal("run s --output o --masks none", "none");
  expect_refusal("run s --output o --segmentation people", "segmentation.source");
  expect_refusal("run s --output o --refinement perhaps", "segmentation.refinement");
  expect_refusal("run s --output o --weights none.safetensors", "none.safetensors");
  folder_.write("bad.safetensors", std::string("not weights"));
  expect_refusal("run s --output o --weights bad.safetensors", "bad.safetensors");
}

TEST_F(SemanticCommandLine, AblationFillsAllColumns) {
  make_sequence();
  make_masks(12);
  const Outcome outcome = call("ablation s --masks-from masks --markdown --output o --quiet");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "| Sequence | OS3 | OS3+S | OS3+S+SRM | OS3+S+SRM+Q | OS3+Q |"));
  EXPECT_EQ(content(folder_ / "o/ablation.md"), outcome.out);
  const auto json = nlohmann::json::parse(content(folder_ / "o/ablation.json"));
  EXPECT_EQ(json["s"].size(), 5U);
  for (const auto& column : json["s"]) {
    EXPECT_LT(column["ate_rmse_m"], 0.005);
    EXPECT_EQ(column["coverage"], 1);
  }
}

TEST_F(SemanticCommandLine, AblationHasThreeMoreColumnsForMotion) {
  make_sequence();
  make_masks(12);
  const Outcome outcome = call("ablation s --masks-from masks --motion --output o --quiet");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(content(folder_ / "o/ablation.json"));
  EXPECT_EQ(json["s"].size(), 8U);
  for (const char* title : {"STDC-SLAM+multi-view", "STDC-SLAM+flow", "STDC-SLAM+map"}) {
    ASSERT_TRUE(json["s"].contains(title)) << title;
    EXPECT_EQ(json["s"][title]["coverage"], 1) << title;
  }
}

TEST_F(SemanticCommandLine, AblationRefusesSequencesWithoutTruth) {
  make_sequence(3);
  fs::remove(folder_ / "s/groundtruth.txt");
  expect_refusal("ablation s --masks-from masks --output o", "groundtruth.txt");
}

TEST_F(SemanticCommandLine, SettingsThatShipAreKnownByName) {
  const Outcome outcome = call("settings --settings os3-s-srm --yaml");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "  selection: orb-slam3 "));
  EXPECT_TRUE(contains(outcome.out, "  source: network "));
  EXPECT_TRUE(contains(call("settings --settings os3-s --yaml").out, "  refinement: false "));
}

}  // namespace
}  // namespace stdc::app
