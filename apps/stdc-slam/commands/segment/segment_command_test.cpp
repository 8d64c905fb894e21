// Runs `stdc-slam segment` as a user does.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>

#include "commands/segment/segment_images.hpp"
#include "core/images/test_exif.hpp"
#include "core/random.hpp"
#include "report/segment_report.hpp"
#include "run/test_sequence.hpp"

namespace stdc::app {
namespace {

namespace fs = std::filesystem;
using stdc::test::TestFolder;

std::string content(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

struct Segmented {
  int code = -1;
  std::string out, err;
};

class SegmentCommand : public ::testing::Test {
 protected:
  Segmented call(const std::string& arguments, const std::string& weights = STDC_TEST_WEIGHTS) const {
    const std::string command = fmt::format("cd {} && {} segment {} --weights {} > .out 2> .err",
                                            folder_.path().string(), STDC_PROGRAM, arguments, weights);
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(folder_ / ".out"),
            content(folder_ / ".err")};
  }
  void make_images() const {
    for (int i = 0; i < 3; ++i) {
      cv::Mat image = test::test_texture(160).colRange(10 * i, 10 * i + 120), colour;
      cv::cvtColor(image, colour, cv::COLOR_GRAY2BGR);
      folder_.write(fmt::format("in/{}.{}", i, i == 1 ? "jpg" : "png"),
                    i == 1 ? encode_jpeg(colour) : encode_png(colour));
    }
  }
  cv::Mat mask(const std::string& name) const { return load_segment_image(folder_ / name).colour; }
  void expect_refusal(const std::string& arguments, const std::string& part) const {
    const Segmented outcome = call(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, part)) << outcome.err << "has no\n" << part;
    EXPECT_FALSE(fs::exists(folder_ / "o"));
  }

  TestFolder folder_;
};

TEST_F(SegmentCommand, WritesMasksOverlaysAndTimes) {
  make_images();
  const Segmented outcome = call("in --output o --size 96x64");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "images      3\n")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "STDC1-Seg"));
  for (const char* name : {"o/0", "o/1", "o/2"}) {
    EXPECT_EQ(mask(name + std::string(".png")).size(), cv::Size(120, 160));
    EXPECT_EQ(mask(name + std::string("-overlay.jpg")).type(), CV_8UC3);
  }
  const std::string table = content(folder_ / "o/segments.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4);

  ASSERT_EQ(call("in/1.jpg --output one --size 96x64 --no-overlays --quiet").code, 0);
  EXPECT_EQ(content(folder_ / "one/1.png"), content(folder_ / "o/1.png"));
  EXPECT_FALSE(fs::exists(folder_ / "one/1-overlay.jpg"));
  ASSERT_EQ(call("in --frames 1:2 --output part --size 96x64 --fp32").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "part/0.png"));
}

TEST_F(SegmentCommand, ScoresAgainstMasksAndLabels) {
  make_images();
  ASSERT_EQ(call("in --output o --size 96x64").code, 0);
  const Segmented same = call("in --output again --size 96x64 --score o");
  ASSERT_EQ(same.code, 0) << same.err;
  EXPECT_TRUE(contains(same.out, "scored      3 images")) << same.out;
  EXPECT_TRUE(contains(same.out, "all pixels  100.0 %")) << same.out;

  cv::Mat labels(160, 120, CV_8UC1, cv::Scalar(1));
  labels.rowRange(0, 80) = 255;  // in doubt: counts nowhere
  folder_.write("labels/2.png", encode_png(labels));
  const Segmented doubtful = call("in --output labelled --size 96x64 --score labels --truth labels");
  ASSERT_EQ(doubtful.code, 0) << doubtful.err;
  EXPECT_TRUE(contains(doubtful.out, "scored      1 images")) << doubtful.out;
  const double found = cv::countNonZero(mask("o/2.png").rowRange(80, 160));
  EXPECT_TRUE(
      contains(content(folder_ / "labelled/segments.csv"), fmt::format(",{:.6f},", found / (80 * 120))));
}

TEST_F(SegmentCommand, HonoursTheOrientationOfPhotos) {
  cv::Mat image;
  cv::cvtColor(test::test_texture(160).colRange(10, 130), image, cv::COLOR_GRAY2BGR);
  for (int value = 1; value <= 8; ++value) {
    const cv::Mat stored = from_upright(image, Orientation{value});
    folder_.write(fmt::format("in/{}.png", value),
                  test::png_with_exif(encode_png(stored), test::exif_data(value)));
  }
  folder_.write("in/9.jpg", test::jpeg_with_exif(encode_jpeg(image), test::exif_data(8)));
  ASSERT_EQ(call("in --output o --size 96x64").code, 0);
  const cv::Mat upright = mask("o/1.png");
  ASSERT_GT(cv::countNonZero(upright), 0);
  for (int value = 1; value <= 8; ++value) {
    const cv::Mat turned = from_upright(upright, Orientation{value});
    ASSERT_EQ(mask(fmt::format("o/{}.png", value)).size(), turned.size()) << value;
    EXPECT_EQ(cv::norm(mask(fmt::format("o/{}.png", value)), turned, cv::NORM_INF), 0) << value;
    EXPECT_EQ(mask(fmt::format("o/{}-overlay.jpg", value)).size(), image.size()) << value;
    folder_.write(fmt::format("upright/{}.png", value), encode_png(upright));
  }
  EXPECT_EQ(mask("o/9.png").size(), image.size());
  EXPECT_EQ(mask("o/9-overlay.jpg").size(), cv::Size(160, 120));
  // Quarter turns tell stored from upright masks.
  const Segmented scored = call("in --frames 4:8 --output scored --size 96x64 --score upright");
  ASSERT_EQ(scored.code, 0) << scored.err;
  EXPECT_TRUE(contains(scored.out, "all pixels  100.0 %")) << scored.out;
}

TEST_F(SegmentCommand, TurnsTheImagesOfATurnedCamera) {
  cv::Mat image;
  cv::cvtColor(test::test_texture(160).colRange(10, 130), image, cv::COLOR_GRAY2BGR);
  folder_.write("upright.png", encode_png(image));
  folder_.write("turned.png", test::png_with_exif(encode_png(from_upright(image, Orientation::rotate_270)),
                                                  test::exif_data(3)));
  folder_.write("c.yaml",
                std::string("width: 160\nheight: 120\nfx: 99\nfy: 99\ncx: 80\ncy: 60\nrotation: 270\n"));
  ASSERT_EQ(call("upright.png --output o --size 96x64").code, 0);
  const Segmented turned = call("turned.png --camera c.yaml --output t --size 96x64");
  ASSERT_EQ(turned.code, 0) << turned.err;
  const cv::Mat expected = from_upright(mask("o/upright.png"), Orientation::rotate_270);
  EXPECT_EQ(cv::norm(mask("t/turned.png"), expected, cv::NORM_INF), 0);
  EXPECT_EQ(mask("t/turned-overlay.jpg").size(), cv::Size(160, 120));
  fs::remove_all(folder_ / "o");
  expect_refusal("upright.png --camera c.yaml --output o --size 96x64",
                 "upright.png: is 120 x 160 pixels, but the camera has 160 x 120");
  expect_refusal("upright.png --camera no.yaml --output o", "no.yaml: cannot be opened");
}

TEST_F(SegmentCommand, ScoresMasksOfAnotherSize) {
  cv::Mat image;
  cv::cvtColor(test::test_texture(160), image, cv::COLOR_GRAY2BGR);
  folder_.write("in/a.png", encode_png(image));
  cv::Mat half(image.rows / 2, image.cols / 2, CV_8UC1, cv::Scalar(0));
  half.colRange(0, 30).setTo(255);
  folder_.write("half/a.png", encode_png(half));
  const Segmented scored = call("in --output scored --size 96x64 --score half");
  ASSERT_EQ(scored.code, 0) << scored.err;
  EXPECT_TRUE(contains(scored.out, "scored      1 images")) << scored.out;
  folder_.write("wide/a.png", encode_png(cv::Mat(40, 90, CV_8UC1, cv::Scalar(0))));
  expect_refusal("in --output o --size 96x64 --score wide",
                 "wide/a.png: is a mask of 90 x 40 pixels, of another shape than its image");
}

TEST_F(SegmentCommand, TellsSeveralClassesApart) {
  make_images();
  const std::string weights = STDC_TEST_FOUR_CLASSES;
  const Segmented all = call("in --output o --size 96x64 --classes", weights);
  ASSERT_EQ(all.code, 0) << all.err;
  const cv::Mat classes = mask("o/1-classes.png"), found = mask("o/1.png");
  EXPECT_EQ(cv::countNonZero((classes != 0) != (found != 0)), 0);
  const std::string table = content(folder_ / "o/segments.csv");
  EXPECT_TRUE(contains(table, "boundary_f,share_person,share_animal,share_vehicle\n")) << table;
  EXPECT_TRUE(contains(all.out, "  animal    ")) << all.out;

  const Segmented one = call("in --output animals --size 96x64 --dynamic animal,person", weights);
  ASSERT_EQ(one.code, 0) << one.err;
  const cv::Mat both = mask("animals/1.png");
  EXPECT_EQ(cv::countNonZero(((classes == 1) | (classes == 2)) != (both != 0)), 0);
  EXPECT_TRUE(contains(content(folder_ / "animals/segments.csv"), ",share_person,share_animal\n"));
  EXPECT_FALSE(fs::exists(folder_ / "animals/1-classes.png"));
  const Segmented unknown = call("in --output none --size 96x64 --dynamic cat", weights);
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(contains(unknown.err, "knows no class 'cat'; choose from background, person, animal, vehicle"))
      << unknown.err;
}

TEST_F(SegmentCommand, WritesProbabilities) {
  make_images();
  ASSERT_EQ(call("in/1.jpg --output o --size 96x64 --probabilities").code, 0);
  const std::string bytes = content(folder_ / "o/1-probability.png");
  const DecodedImage decoded =
      decode_depth({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, {120, 160});
  const cv::Mat& probability = decoded.image;
  ASSERT_EQ(probability.type(), CV_16UC1) << decoded.problem;
  const cv::Mat likely = probability > 32768 + 50, unlikely = probability < 32768 - 50,
                found = mask("o/1.png");
  EXPECT_GT(cv::countNonZero(likely), 0);
  EXPECT_EQ(cv::countNonZero(likely & ~found), 0);
  EXPECT_EQ(cv::countNonZero(unlikely & found), 0);
}

TEST_F(SegmentCommand, RunTakesTheMasksOfASequence) {
  stdc::test::write_test_sequence(folder_, "s", 6);
  ASSERT_EQ(call("s --output o --size 96x64").code, 0);
  EXPECT_EQ(mask("o/3.png").size(), cv::Size(320, 240));
  const std::string run = fmt::format("cd {} && {} run s --masks o --output results --quiet 2> .err",
                                      folder_.path().string(), STDC_PROGRAM);
  EXPECT_EQ(std::system(run.c_str()), 0) << content(folder_ / ".err");
  EXPECT_TRUE(fs::exists(folder_ / "results/trajectory.txt"));
}

TEST_F(SegmentCommand, RefusesBadInput) {
  make_images();
  expect_refusal("none --output o", "none: there is no such image or folder");
  expect_refusal("in --output o --size 100x64", "100x64 is not a size that the network takes");
  expect_refusal("in --output o --size 96", "'96' is not of the form WxH");
  expect_refusal("in --output o --frames 2:9", "goes beyond the 3 frames");
  expect_refusal("in --output o --int8 --fp32", "--fp32");
  expect_refusal("in --output o --size 96x64 --score in --truth words", "'words' is not known");
  expect_refusal("in --output o --size 96x64 --threads 0", "network.threads");
  fs::create_directories(folder_ / "empty");
  expect_refusal("empty --output o", "holds no PNG or JPEG");
  expect_refusal("in --output o --size 96x64 --score empty", "has no mask for any of the images");
  folder_.write("in/0.png", std::string("nonsense"));
  expect_refusal("in --output o --size 96x64", "in/0.png: is neither a PNG nor a JPEG");
}

TEST(SegmentReport, HasQuantilesAndScores) {
  std::vector<SegmentedImage> images;
  for (int i = 1; i <= 101; ++i) images.push_back({fmt::format("{}", i), 0.25, i * 1.0, i * 0.5, {}, {}});
  const std::string plain = segment_summary(images);
  EXPECT_TRUE(contains(plain, "51.0 ms median, 96.0 ms p95 (25.5 ms CPU median, min 0.5 ms)")) << plain;
  EXPECT_TRUE(contains(plain, "dynamic     25.00 % of the pixels\n")) << plain;
  EXPECT_FALSE(contains(plain, "IoU"));
  images[0].counts = MaskCounts{.both = 30, .mask_only = 10, .truth_only = 20};
  EXPECT_TRUE(contains(segment_summary(images), "mean         50.0 %      75.0 %   60.0 %"))
      << segment_summary(images);
  EXPECT_TRUE(contains(segments_csv(images), "1,0.250000,1.000,0.500,0.500000,0.750000,0.600000,\n"));
}

}  // namespace
}  // namespace stdc::app
