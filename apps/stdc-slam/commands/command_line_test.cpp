// Runs the program as a user does: exit codes, messages, and what is left on the disk.
#include <nlohmann/json.hpp>

#include "commands/test_command_line.hpp"

namespace stdc::app {
namespace {

TEST_F(CommandLine, HelpAndVersion) {
  EXPECT_EQ(call("--version").out, STDC_VERSION "\n");
  for (const char* command : {"run", "evaluate", "settings"}) {
    const Outcome outcome = call(std::string(command) + " --help");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(contains(outcome.out, "Examples:")) << command;
    EXPECT_TRUE(contains(call("--help").out, command));
  }
  expect_refusal("", "subcommand");
  expect_refusal("walk", "subcommand");
  expect_refusal("run s --output o --no-such-option", "--no-such-option");
}

TEST_F(CommandLine, RunWritesAllResults) {
  make_sequence();
  const Outcome outcome = call("run s --output o --debug-images p --debug-every 5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "ATE"));
  EXPECT_EQ(lines(content(folder_ / "o/trajectory.txt")), 12);
  EXPECT_GE(lines(content(folder_ / "o/keyframes.txt")), 1);
  EXPECT_EQ(lines(content(folder_ / "o/frames.csv")), 13);
  const auto summary = nlohmann::json::parse(content(folder_ / "o/summary.json"));
  EXPECT_EQ(summary["version"], STDC_VERSION);
  EXPECT_EQ(summary["frames"]["ok"], 12);
  EXPECT_EQ(summary["coverage"], 1.0);
  EXPECT_EQ(summary["settings"]["features"]["selection"], "improved");
  EXPECT_EQ(summary["camera"]["fx"], 300.0);
  EXPECT_LT(summary["scores"]["ate_m"]["rmse"], 0.005);
  EXPECT_GT(summary["peak_memory_mb"], 1);
  EXPECT_TRUE(fs::exists(folder_ / "o/report.html"));
  EXPECT_TRUE(fs::exists(folder_ / "p/keypoints_000005.png"));
}

TEST_F(CommandLine, RunGivesTheSameBytesAgain) {
  make_sequence();
  ASSERT_EQ(call("run s --output o --quiet").code, 0);
  ASSERT_EQ(call("run s --output o2 --quiet --debug-images p").code, 0);
  EXPECT_EQ(content(folder_ / "o/trajectory.txt"), content(folder_ / "o2/trajectory.txt"));
  EXPECT_EQ(content(folder_ / "o/keyframes.txt"), content(folder_ / "o2/keyframes.txt"));
}

TEST_F(CommandLine, RunTakesPartOfTheFramesAndSettings) {
  make_sequence();
  const Outcome outcome = call(
      "run s --output o --quiet --frames 3:9 --selection orb-slam3 --set features.keypoints=500 "
      "--set features.keypoints=600");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  const auto summary = nlohmann::json::parse(content(folder_ / "o/summary.json"));
  EXPECT_EQ(summary["frames"]["total"], 6);
  EXPECT_EQ(summary["first_frame"], 3);
  EXPECT_EQ(summary["settings"]["features"]["selection"], "orb-slam3");
  EXPECT_EQ(summary["settings"]["features"]["keypoints"], 600);
}

TEST_F(CommandLine, ACorruptImageInMidSequenceIsSkipped) {
  make_sequence();
  fs::resize_file(folder_ / "s/rgb/5.png", 200);
  fs::remove(folder_ / "s/depth/8.png");
  const Outcome outcome = call("run s --output o --quiet");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(lines(outcome.err), 2) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "s/rgb/5.png (rgb.txt:7): the PNG ends too early")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "s/depth/8.png (depth.txt:10): cannot be opened")) << outcome.err;
  EXPECT_TRUE(contains(content(folder_ / "o/frames.csv"), "\n5,100.166667,skipped,"));
  EXPECT_EQ(lines(content(folder_ / "o/trajectory.txt")), 10);
}

TEST_F(CommandLine, RunRefusesBadSequences) {
  expect_refusal("run s --output o", "s: there is no such folder");
  make_sequence(3);
  const std::string rgb = content(folder_ / "s/rgb.txt");
  folder_.write("s/rgb.txt", std::string("# nothing\n"));
  expect_refusal("run s --output o", "s/rgb.txt: lists no images");
  folder_.write("s/rgb.txt", std::string("nan rgb/0.png\n"));
  expect_refusal("run s --output o", "s/rgb.txt:1: the timestamp 'nan' is not a finite number");
  folder_.write("s/rgb.txt", std::string("100 rgb/0.png\n\n99 rgb/1.png\n"));
  expect_refusal("run s --output o", "s/rgb.txt:3: the timestamp 99.000000 is not later");
  folder_.write("s/rgb.txt", std::string("500 rgb/0.png\n"));
  expect_refusal("run s --output o", "within 20 ms");
  folder_.write("s/rgb.txt", rgb);
}

TEST_F(CommandLine, RunRefusesBadFirstImages) {
  make_sequence(3);
  const std::string good = content(folder_ / "s/rgb/0.png");
  folder_.write("s/rgb/0.png", good.substr(0, 300));
  expect_refusal("run s --output o", "s/rgb/0.png (rgb.txt:2): the PNG ends too early");
  folder_.write("s/rgb/0.png", encode_png(cv::Mat(120, 160, CV_8UC3, cv::Scalar(1))));
  expect_refusal("run s --output o", "is 160 x 120 pixels, but the camera has 320 x 240");
  folder_.write("s/rgb/0.png", encode_png(cv::Mat(240, 320, CV_16UC1, cv::Scalar(1))));
  expect_refusal("run s --output o", "has 1 channel(s) of 16 bits");
  folder_.write("s/rgb/0.png", good);
  folder_.write("s/depth/0.png", encode_png(cv::Mat(240, 320, CV_8UC1, cv::Scalar(1))));
  expect_refusal("run s --output o", "s/depth/0.png (depth.txt:2): has 1 channel(s) of 8 bits");
  fs::remove(folder_ / "s/depth/0.png");
  expect_refusal("run s --output o", "s/depth/0.png (depth.txt:2): cannot be opened");
}

TEST_F(CommandLine, RunRefusesBadOptions) {
  make_sequence(3);
  expect_refusal("run s", "--output");
  expect_refusal("run s --output o --set features.keypoint=3", "features.keypoint");
  expect_refusal("run s --output o --set features.keypoints=many", "features.keypoints");
  expect_refusal("run s --output o --set features.keypoints=1", "features.keypoints");
  expect_refusal("run s --output o --selection best", "features.selection");
  expect_refusal("run s --output o --settings none.yaml", "none.yaml");
  folder_.write("bad.yaml", std::string("features:\n  keypoints: 700\n  colour: red\n"));
  expect_refusal("run s --output o --settings bad.yaml", "bad.yaml:3: ");
  expect_refusal("run s --output o --frames 5:2", "--frames");
  expect_refusal("run s --output o --debug-every 0 --debug-images p", "--debug-every");
  fs::remove(folder_ / "s/camera.yaml");
  expect_refusal("run s --output o", "s: its camera is not known");
  expect_refusal("run s --output o --camera none.yaml", "none.yaml: cannot be opened");
  folder_.write("c.yaml", std::string("width: 320\nheight: 240\nfx: x\n"));
  expect_refusal("run s --output o --camera c.yaml", "c.yaml:3: fx is not a finite number");
}

TEST_F(CommandLine, RunRefusesAnUnwritableOutput) {
  make_sequence(3);
  folder_.write("file", std::string("x"));
  expect_refusal("run s --output file", "file: is not a folder");
  expect_refusal("run s --output file/o", "file/o: cannot be made");
  expect_refusal("run s --output o --debug-images file/p", "file/p: cannot be made");
}

TEST_F(CommandLine, ABadTruthIsNoReasonNotToRun) {
  make_sequence();
  folder_.write("s/groundtruth.txt",
                content(folder_ / "s/groundtruth.txt") + "200 nan nan nan nan nan nan nan\n");
  const Outcome outcome = call("run s --output o --quiet --segmentation off");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.err, "1 of 13 rows are left out (1 without a pose)")) << outcome.err;
  const auto summary = nlohmann::json::parse(content(folder_ / "o/summary.json"));
  EXPECT_EQ(summary["groundtruth"]["left_out"], 1);
  EXPECT_EQ(summary["scores"]["pairs"], 12);
  EXPECT_TRUE(summary["scores"]["rpe_second_translation_m"]["rmse"].is_null());
  folder_.write("s/groundtruth.txt", std::string("100 0 0 0\n"));
  EXPECT_EQ(call("run s --output o --quiet --segmentation off").code, 0);
}

TEST_F(CommandLine, NothingCameOfIt) {
  make_sequence(3);
  for (const char* image : {"s/rgb/0.png", "s/rgb/1.png", "s/rgb/2.png"})
    folder_.write(image, encode_png(cv::Mat(240, 320, CV_8UC1, cv::Scalar(0))));
  folder_.write("good.map", std::string("good"));
  const Outcome outcome = call("run s --output o --quiet --segmentation off --save-map good.map");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_TRUE(contains(outcome.err, "not one of 3 frames got a pose")) << outcome.err;
  EXPECT_EQ(content(folder_ / "good.map"), "good");
  EXPECT_TRUE(fs::exists(folder_ / "o/summary.json"));
}

TEST_F(CommandLine, TheCameraOfTheCommandLineGoesFirst) {
  make_sequence(3);
  Camera camera = stdc::test::test_camera();
  camera.fx = 333;
  folder_.write("mine.yaml", format_camera(camera));
  EXPECT_EQ(call("run s --output o --quiet --segmentation off --camera mine.yaml").code, 0);
  EXPECT_EQ(nlohmann::json::parse(content(folder_ / "o/summary.json"))["camera"]["fx"], 333);
}

TEST_F(CommandLine, OptionsWithoutEffectAreRefused) {
  make_sequence(3);
  expect_refusal("run s --output o --camera none.yaml", "none.yaml: cannot be opened");
  expect_refusal("run s --output o --debug-every 5", "--debug-every");
  expect_refusal("run s --output o --segmentation off --masks s", "--masks");
  expect_refusal("run s --output o --segmentation off --weights w", "--weights");
  expect_refusal("run s --output o --segmentation off --refinement on", "--refinement");
}

TEST_F(CommandLine, EvaluateAgreesWithRun) {
  make_sequence();
  ASSERT_EQ(call("run s --output o --quiet").code, 0);
  const Outcome outcome = call("evaluate s/groundtruth.txt o/trajectory.txt --json");
  ASSERT_EQ(outcome.code, 0);
  const auto scores = nlohmann::json::parse(outcome.out);
  const auto summary = nlohmann::json::parse(content(folder_ / "o/summary.json"));
  EXPECT_NEAR(scores["ate_m"]["rmse"], summary["scores"]["ate_m"]["rmse"], 1e-6);
  EXPECT_EQ(scores["pairs"], 12);
  EXPECT_TRUE(contains(call("evaluate s/groundtruth.txt o/trajectory.txt").out, "RPE per frame, rotation"));
}

TEST_F(CommandLine, EvaluateRefusesBadInput) {
  folder_.write("t.txt", std::string("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n"));
  folder_.write("bad.txt", std::string("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0\n"));
  expect_refusal("evaluate t.txt none.txt", "none.txt: cannot be opened");
  EXPECT_TRUE(
      contains(call("evaluate bad.txt t.txt").err, "bad.txt: 1 of 2 rows are left out (1 malformed)"));
  expect_refusal("evaluate t.txt t.txt", "t.txt: only 2 of 2");
  expect_refusal("evaluate t.txt t.txt --max-difference 0", "--max-difference");
}

TEST_F(CommandLine, SettingsPrintsWhatItReads) {
  const Outcome table = call("settings");
  EXPECT_TRUE(contains(table.out, "features.keypoints"));
  EXPECT_TRUE(contains(table.out, "1000 count"));
  const Outcome yaml = call("settings --yaml --set features.keypoints=1234");
  folder_.write("mine.yaml", yaml.out);
  EXPECT_EQ(call("settings --yaml --settings mine.yaml").out, yaml.out);
  expect_refusal("settings --set nonsense", "nonsense");
}

}  // namespace
}  // namespace stdc::app
