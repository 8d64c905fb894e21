#include "segmentation/mask_file_segmenter.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/files/test_folder.hpp"
#include "core/images/image_codec.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;

/// A mask whose left `columns` columns are 255.
cv::Mat mask_of(int columns, cv::Size size = {80, 60}) {
  cv::Mat mask = cv::Mat::zeros(size, CV_8UC1);
  mask.colRange(0, columns) = 255;
  return mask;
}

SegmenterInput input_at(double timestamp, cv::Size size = {80, 60}) {
  return {cv::Mat(size, CV_8UC3, cv::Scalar::all(90)), timestamp, 0};
}

int columns_of(const cv::Mat& mask) { return cv::countNonZero(mask) / mask.rows; }

TEST(MaskFileSegmenter, FindsMasksByTheNameOfTheColourImage) {
  const TestFolder folder;
  folder.write("1305031102.175304.png", encode_png(mask_of(10)));
  folder.write("1305031102.211214.png", encode_png(mask_of(20)));
  folder.write("1305031099.png", encode_png(mask_of(30)));
  folder.write("overlay.png", std::string("no mask"));
  folder.write("1305031102.211214.txt", std::string("no mask"));
  MaskFileSegmenter segmenter(folder.path());
  const cv::Mat mask = segmenter.segment(input_at(1305031102.175304));
  EXPECT_EQ(mask.type(), CV_8UC1);
  EXPECT_EQ(cv::norm(mask, mask_of(10), cv::NORM_L1), 0);
  EXPECT_EQ(columns_of(segmenter.segment(input_at(1305031102.211214))), 20);
  EXPECT_EQ(columns_of(segmenter.segment(input_at(1305031099))), 30);
}

TEST(MaskFileSegmenter, AllowsOneMillisecondAndTakesTheNearest) {
  const TestFolder folder;
  folder.write("10.0000.png", encode_png(mask_of(10)));
  folder.write("10.0015.png", encode_png(mask_of(20)));
  MaskFileSegmenter segmenter(folder.path());
  EXPECT_EQ(columns_of(segmenter.segment(input_at(9.9991))), 10);
  EXPECT_EQ(columns_of(segmenter.segment(input_at(10.0007))), 10);
  EXPECT_EQ(columns_of(segmenter.segment(input_at(10.0008))), 20);
  EXPECT_EQ(columns_of(segmenter.segment(input_at(10.0024))), 20);
  EXPECT_TRUE(segmenter.segment(input_at(9.9988)).empty());
  EXPECT_TRUE(segmenter.segment(input_at(10.0027)).empty());
}

TEST(MaskFileSegmenter, FollowsAList) {
  const TestFolder folder;
  folder.write("mask/a.png", encode_png(mask_of(10)));
  folder.write("mask/b.png", encode_png(mask_of(20)));
  folder.write("3.0.png", encode_png(mask_of(30)));
  folder.write("mask.txt", std::string("# masks\n1.0 mask/a.png\n2.0 mask/b.png\n2.5 mask/c.png\n"));
  MaskFileSegmenter segmenter(folder.path());
  EXPECT_EQ(columns_of(segmenter.segment(input_at(2.0))), 20);
  EXPECT_TRUE(segmenter.segment(input_at(3.0)).empty());  // a list leaves out what it does not name
  EXPECT_NE(
      message_of([&] { segmenter.segment(input_at(2.5)); }).find("c.png (mask.txt:4): cannot be opened"),
      std::string::npos);
}

TEST(MaskFileSegmenter, TheMiddleOfTheRangeDecides) {
  const TestFolder folder;
  cv::Mat grey = (cv::Mat_<std::uint8_t>(1, 5) << 0, 1, 127, 128, 255);
  folder.write("1.png", encode_png(grey));
  const cv::Mat mask = MaskFileSegmenter(folder.path()).segment(input_at(1, {5, 1}));
  const cv::Mat wanted = (cv::Mat_<std::uint8_t>(1, 5) << 0, 0, 0, 255, 255);
  EXPECT_EQ(cv::norm(mask, wanted, cv::NORM_L1), 0);
}

TEST(MaskFileSegmenter, NamesTheFileAtFault) {
  const TestFolder folder;
  folder.write("1.png", encode_png(mask_of(10, {40, 30})));
  std::vector<std::uint8_t> cut = encode_png(mask_of(10));
  cut.resize(cut.size() / 2);
  folder.write("2.png", cut);
  folder.write("3.png", std::string("nonsense"));
  folder.write("4.png", encode_png(cv::Mat(60, 80, CV_8UC3, cv::Scalar(0, 0, 255))));
  folder.write("5.png", encode_png(mask_of(10) / 255));
  folder.write("6.png", encode_png(cv::Mat(60, 80, CV_16UC1, cv::Scalar(65535))));
  folder.write("7.png", std::string());
  MaskFileSegmenter segmenter(folder.path());
  const char* problems[] = {"40 x 30",        "PNG", "not a PNG", "colour image",
                            "labels up to 1", "16",  "not a PNG"};
  for (int i = 1; i <= 7; ++i) {
    const std::string message = message_of([&] { segmenter.segment(input_at(i)); });
    EXPECT_NE(message.find(std::to_string(i) + ".png"), std::string::npos) << message;
    EXPECT_NE(message.find(problems[i - 1]), std::string::npos) << message;
  }
}

TEST(MaskFileSegmenter, AMaskOfZerosIsAMask) {
  const TestFolder folder;
  folder.write("1.png", encode_png(mask_of(0)));
  const cv::Mat mask = MaskFileSegmenter(folder.path()).segment(input_at(1));
  EXPECT_EQ(mask.size(), cv::Size(80, 60));
  EXPECT_EQ(cv::countNonZero(mask), 0);
}

TEST(MaskList, SaysWhatIsWrongWithAFolder) {
  const TestFolder folder;
  EXPECT_NE(message_of([&] { list_masks(folder / "none"); }).find("is not a folder"), std::string::npos);
  EXPECT_NE(message_of([&] { list_masks(folder.path()); }).find("holds no masks"), std::string::npos);
  folder.write("1.0.png", encode_png(mask_of(1)));
  folder.write("1.00.png", encode_png(mask_of(1)));
  EXPECT_NE(message_of([&] { list_masks(folder.path()); }).find("has the same time as"), std::string::npos);
  folder.write("mask.txt", std::string("2.0 1.0.png\n1.0 1.00.png\n"));
  EXPECT_NE(message_of([&] { list_masks(folder.path()); }).find("mask.txt:2"), std::string::npos);
}

}  // namespace
}  // namespace stdc
