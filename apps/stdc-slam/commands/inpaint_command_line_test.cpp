// `run --inpaint` as a user meets it.
#include <opencv2/core.hpp>

#include "commands/test_command_line.hpp"

namespace stdc::app {
namespace {

/// The sequence "s" of a camera moving sideways before a wall; from frame 6 on a red square, 1 m away, hides
/// part of it, which s/mask tells. "clean" is the same without the square.
class InpaintCommandLine : public CommandLine {
 protected:
  static constexpr int kFrames = 12, kFirstMover = 6;
  static cv::Rect mover(int frame) { return {100 + 4 * frame, 80, 60, 60}; }

  void make_mover() const {
    make_sequence(kFrames);
    fs::copy(folder_ / "s", folder_ / "clean", fs::copy_options::recursive);
    std::string list;
    for (int i = 0; i < kFrames; ++i) {
      cv::Mat mask(240, 320, CV_8UC1, cv::Scalar(0));
      if (i >= kFirstMover) {
        cv::Mat colour = colour_of("s", fmt::format("rgb/{}.png", i)),
                depth = depth_of("s", fmt::format("depth/{}.png", i));
        colour(mover(i)) = cv::Scalar(0, 0, 255);
        depth(mover(i)) = 5000;
        mask(mover(i)) = 255;
        folder_.write(fmt::format("s/rgb/{}.png", i), encode_png(colour));
        folder_.write(fmt::format("s/depth/{}.png", i), encode_png(depth));
      }
      folder_.write(fmt::format("s/mask/{}.png", i), encode_png(mask));
      list += fmt::format("{:.6f} {}.png\n", 100 + i / 30.0, i);
    }
    folder_.write("s/mask/mask.txt", list);
  }
  cv::Mat colour_of(const std::string& sequence, const std::string& name) const {
    return decode_colour(bytes(sequence, name), {320, 240}, ColourMode::as_stored).image;
  }
  cv::Mat depth_of(const std::string& sequence, const std::string& name) const {
    return decode_depth(bytes(sequence, name), {320, 240}).image;
  }
  static std::string stamp(double time) { return fmt::format("{:.6f}.png", time); }
  static constexpr const char* kInpaintRun = "run s -o o --segmentation masks --refinement off --motion off ";

 private:
  std::vector<std::uint8_t> bytes(const std::string& sequence, const std::string& name) const {
    const std::string text = content(folder_ / sequence / name);
    return {text.begin(), text.end()};
  }
};

TEST_F(InpaintCommandLine, WritesASequenceWithoutWhatMoves) {
  make_mover();
  const Outcome outcome = call(std::string(kInpaintRun) + "--inpaint d/in");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "inpainted: d/in (12 frames, 100 % of what was replaced is known"))
      << outcome.out;
  EXPECT_EQ(content(folder_ / "d/in/groundtruth.txt"), content(folder_ / "s/groundtruth.txt"));
  for (int i = 0; i < kFrames; ++i) {
    const std::string name = stamp(100 + i / 30.0);
    const cv::Mat colour = colour_of("d/in", "rgb/" + name),
                  clean = colour_of("clean", fmt::format("rgb/{}.png", i));
    const cv::Mat unknown = colour_of("d/in", "unknown/" + name);
    ASSERT_FALSE(colour.empty() || unknown.empty()) << name;
    EXPECT_EQ(cv::countNonZero(unknown), 0);
    // Sharp blots, resampled twice: a few grey levels.
    EXPECT_LT(cv::norm(colour, clean, cv::NORM_L1) / static_cast<double>(colour.total() * 3), 1.5) << i;
    const cv::Mat depth = depth_of("d/in", "depth/" + stamp(100 + i / 30.0 + 0.003));
    EXPECT_LT(cv::norm(depth, depth_of("clean", fmt::format("depth/{}.png", i)), cv::NORM_INF), 100) << i;
  }
  // It can be run on.
  EXPECT_EQ(call("run d/in -o o2 --segmentation off --motion off").code, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "d"), fs::directory_iterator()), 1);
}

TEST_F(InpaintCommandLine, GivesTheSameBytesAgainAndReplacesItsOwnFolder) {
  make_mover();
  ASSERT_EQ(call(std::string(kInpaintRun) + "--inpaint a").code, 0);
  ASSERT_EQ(call(std::string(kInpaintRun) + "--inpaint b").code, 0);
  ASSERT_EQ(call(std::string(kInpaintRun) + "--inpaint b/").code, 0);
  for (const char* part : {"rgb", "unknown"}) {
    const std::string name = fmt::format("{}/{}", part, stamp(100 + 9 / 30.0));
    ASSERT_FALSE(content(folder_ / "a" / name).empty());
    EXPECT_EQ(content(folder_ / "a" / name), content(folder_ / "b" / name));
  }
}

TEST_F(InpaintCommandLine, OnlyWithAllItLooksIntoTheFuture) {
  make_mover();
  // The square is there from the first frame on that is taken: most of what it hides is seen later, if at
  // all.
  ASSERT_EQ(call(std::string(kInpaintRun) + "--frames 6: --inpaint past").code, 0);
  ASSERT_EQ(call(std::string(kInpaintRun) + "--frames 6: --inpaint all --inpaint-all").code, 0);
  const std::string first = "unknown/" + stamp(100 + 6 / 30.0);
  const int past = cv::countNonZero(colour_of("past", first)),
            all = cv::countNonZero(colour_of("all", first));
  EXPECT_GE(past, mover(6).area());
  EXPECT_LT(all, past);
}

TEST_F(InpaintCommandLine, RefusesInOneLineAndWritesNothing) {
  make_mover();
  expect_refusal("run s -o o --segmentation off --motion off --inpaint d", "there is nothing to inpaint");
  expect_refusal(std::string(kInpaintRun) + "--inpaint s", "is the folder of the sequence itself");
  folder_.write("full/thesis.txt", std::string("words"));
  expect_refusal(std::string(kInpaintRun) + "--inpaint full", "has something else in it (\"thesis.txt\")");
  expect_refusal(std::string(kInpaintRun) + "--inpaint full/thesis.txt", "is not a folder");
  expect_refusal(std::string(kInpaintRun) + "--inpaint o", "cannot be put into the folder of --inpaint");
  fs::remove_all(folder_ / "clean/mask");
  expect_refusal(std::string(kInpaintRun) + "--inpaint clean",
                 "holds a sequence that --inpaint did not write");
  EXPECT_FALSE(fs::exists(folder_ / "d"));
  EXPECT_EQ(content(folder_ / "full/thesis.txt"), "words");
  const Outcome alone = call(std::string(kInpaintRun) + "--inpaint-all");
  EXPECT_EQ(alone.code, 2);
  EXPECT_EQ(lines(alone.err), 1) << alone.err;
  EXPECT_TRUE(contains(alone.err, "--inpaint")) << alone.err;
}

}  // namespace
}  // namespace stdc::app
