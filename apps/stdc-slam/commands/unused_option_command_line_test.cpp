// What the user gives is used, or refused with one line; it is never dropped in silence.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "atlas/storage/map_file.hpp"
#include "commands/test_command_line.hpp"

namespace stdc::app {
namespace {

class UnusedOption : public CommandLine {
 protected:
  /// Puts the times of the truth of "s" an hour later.
  void move_truth() const {
    std::string text;
    for (int i = 0; i < 12; ++i)
      text += fmt::format("{:.6f} {:.6f} 0 0 0 0 0 1\n", 3700 + i / 30.0, 0.01 * i);
    folder_.write("s/groundtruth.txt", text);
  }
  void write_images(const std::string& name) const {
    folder_.write(name + ".png", encode_png(cv::Mat(120, 160, CV_8UC3, cv::Scalar(90, 90, 90))));
  }
  static std::string weights() { return std::string(" --size 96x64 --weights ") + STDC_TEST_WEIGHTS; }
};

TEST_F(UnusedOption, AnOptionAndAnAssignmentOfTheSameSettingAreRefused) {
  make_sequence(3);
  expect_refusal("settings --selection improved --set features.selection=orb-slam3",
                 "--selection: is the same setting as --set features.selection=orb-slam3");
  expect_refusal("run s --output o --segmentation off --set segmentation.source=off", "--segmentation: ");
  expect_refusal("run s --output o --refinement on --set segmentation.refinement=off", "--refinement: ");
  expect_refusal("run s --output o --localisation-only --set system.localisation_only=off",
                 "--localisation-only: ");
}

TEST_F(UnusedOption, AnEmptySettingsFileIsRefused) {
  folder_.write("empty.yaml", std::string("# nothing yet\n"));
  expect_refusal("settings --settings empty.yaml", "empty.yaml: holds no settings");
}

TEST_F(UnusedOption, ATruthThatSharesNoTimeIsSaidEvenIfQuiet) {
  make_sequence();
  move_truth();
  const Outcome outcome = call("run s --output o --segmentation off --quiet");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "s/groundtruth.txt: there are no scores, only 0 of 12")) << outcome.err;
  fs::remove_all(folder_ / "o");
  expect_refusal("places s --output o --quiet", "s/groundtruth.txt: has no pose within 20 ms of any image");
}

TEST_F(UnusedOption, ATruthWithoutAnyPoseIsSaidAsSuch) {
  make_sequence();
  folder_.write("s/groundtruth.txt", std::string("100 0 0 0\n"));
  for (const char* command : {"places s --output o --quiet", "ablation s --output o --quiet"}) {
    expect_refusal(command, "s/groundtruth.txt: holds no pose, 1 of 1 rows are left out (1 malformed)");
  }
  const Outcome outcome = call("run s --output o --segmentation off --quiet");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "s/groundtruth.txt: holds no pose, ")) << outcome.err;
  fs::remove_all(folder_ / "o");
  fs::remove(folder_ / "s/groundtruth.txt");
  expect_refusal("places s --output o", "s/groundtruth.txt: there is no such file");
}

TEST_F(UnusedOption, FeaturesTakesFramesBeforeTheSequence) {
  make_sequence(3);
  const Outcome outcome = call("features --frames 0,2 s --json --quiet");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["frames"].size(), 2U);
  expect_refusal("features s --frames 0,3", "--frames: there is no frame 3");
  expect_refusal("features s --keypoints 3", "--keypoints: 3 is outside 50..20000");
}

TEST_F(UnusedOption, PlacesSaysWhatIsLeftOutAndLeavesEmptyWhatIsNotThere) {
  make_sequence();
  std::string truth;
  for (int i = 0; i < 6; ++i) truth += fmt::format("{:.6f} {:.6f} 0 0 0 0 0 1\n", 100 + i / 30.0, 0.01 * i);
  folder_.write("s/groundtruth.txt", truth);
  const Outcome outcome = call("places s --step 1 --output o --quiet --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "6 views have no pose within 20 ms and are left out")) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(json["average_precision"].is_null());
  EXPECT_TRUE(json["worst_error_m"].is_null());
  EXPECT_TRUE(contains(content(folder_ / "o/places.csv"), "\n0,0.0000,,,,,0,,\n"))
      << content(folder_ / "o/places.csv");
  fs::remove_all(folder_ / "o");
  expect_refusal("places s --frames 0:99 --output o", "--frames: 0:99");
}

TEST_F(UnusedOption, SegmentNeedsScoreForTruth) {
  write_images("in/a");
  expect_refusal("segment in --output o --truth labels" + weights(), "--truth requires --score");
}

TEST_F(UnusedOption, SegmentRefusesWhatAnOnnxModelIgnores) {
  write_images("in/a");
  for (const char* option : {"--int8", "--fp32", "--threads 2"}) {
    expect_refusal(fmt::format("segment in --output o --weights net.onnx {}", option),
                   "has no effect on an ONNX model");
  }
}

TEST_F(UnusedOption, SegmentSaysWhatItLeavesOut) {
  write_images("in/a");
  write_images("in/b");
  folder_.write("in/c.BMP", std::string("BM"));
  folder_.write("in/d.webp", std::string("RIFF"));
  folder_.write("in/notes.txt", std::string("mine"));
  folder_.write("truth/b.png", encode_png(cv::Mat(120, 160, CV_8UC1, cv::Scalar(0))));
  const Outcome outcome = call("segment in --output o --quiet --score truth" + weights());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(lines(outcome.err), 2) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "in: 2 images are neither PNG nor JPEG and are left out, such as c.BMP"))
      << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "truth: has no mask for 1 of 2 images, such as a; they are not scored"))
      << outcome.err;
}

TEST_F(UnusedOption, AblationRefusesBeforeAnyWork) {
  make_sequence(3);
  stdc::test::write_test_sequence(folder_, "other/s", 3);
  expect_refusal("ablation s --output o --set segmentation.refinement=on",
                 "--set segmentation.refinement=on: the columns differ in this setting");
  expect_refusal("ablation s --output o --set features.selection=improved",
                 "--set features.selection=improved: ");
  expect_refusal("ablation s --output o --motion --set motion.method=off",
                 "--set motion.method=off: the columns differ");
  expect_refusal("ablation s --output o --masks-from masks --weights w",
                 "--weights: is of no use with --masks-from masks");
  expect_refusal("ablation s --output o --quiet --weights none.safetensors", "none.safetensors: ");
  expect_refusal("ablation s --output o --quiet --masks-from masks", "s/mask: ");
  folder_.write("s/mask/5.000000.png", encode_png(cv::Mat(240, 320, CV_8UC1, cv::Scalar(0))));
  expect_refusal("ablation s --output o --quiet --masks-from masks",
                 "none of its 1 masks has the name, time or number of an image");
  expect_refusal(std::string("ablation s other/s --output o --quiet --weights ") + STDC_TEST_WEIGHTS,
                 "other/s: has the same name as s");
}

TEST_F(UnusedOption, AblationSaysOnceThatATruthIsOfNoUse) {
  make_sequence();
  move_truth();
  const Outcome outcome = call(std::string("ablation s --quiet --weights ") + STDC_TEST_WEIGHTS);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "s/groundtruth.txt: there are no scores, ")) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, " - (100.0 %)")) << outcome.out;
}

TEST_F(UnusedOption, AnEmptyMapIsNotExported) {
  save_map(folder_ / "empty.map", stdc::test::test_camera(), Atlas());
  expect_refusal("map export empty.map --output o", "empty.map: holds an empty map");
}

}  // namespace
}  // namespace stdc::app
