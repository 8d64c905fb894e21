#include "input/layouts/scannet/sens_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "input/frame_decoder.hpp"
#include "input/layouts/scannet/sens_index.hpp"
#include "input/layouts/scannet/test_sens.hpp"
#include "input/open_source.hpp"

namespace stdc {
namespace {

using test::make_sens;
using test::message_of;
using test::TestFolder;

std::string index_message(const std::string& text) {
  return message_of([&] {
    std::istringstream file(text);
    read_sens_index(file, "a.sens");
  });
}

TEST(SensFile, GivesFramesPosesAndTimes) {
  const TestFolder folder;
  folder.write("a.sens", make_sens(3));
  const auto source = open_source(folder / "a.sens");
  EXPECT_EQ(source->kind(), "sens");
  EXPECT_FALSE(source->cameras()->depth) << "both cameras are the same";
  const FrameDecoder decoder(*source->cameras());
  for (int i = 0; i < 3; ++i) {
    const auto frame = source->next();
    ASSERT_TRUE(frame);
    EXPECT_NEAR(frame->timestamp, 1 + 0.033333 * i, 1e-9);
    const RgbdImage image = decoder.decode(*frame, ColourMode::as_stored);
    EXPECT_EQ(image.depth.at<std::uint16_t>(9, 9), 1000 + i);
    EXPECT_NEAR(image.colour.at<cv::Vec3b>(9, 9)[2], 50, 3);
  }
  EXPECT_FALSE(source->next());
  const GroundTruth truth = source->ground_truth().value();
  EXPECT_EQ(truth.poses.size(), 2U);
  EXPECT_EQ(truth.without_pose, 1);
  EXPECT_NEAR(truth.poses[1].world_from_cam.translation.x(), 0.2, 1e-6);
}

TEST(SensFile, WithoutTimesCountsFrames) {
  const TestFolder folder;
  folder.write("a.sens", make_sens(2, false));
  const auto source = open_source(folder / "a.sens");
  source->next();
  EXPECT_NEAR(source->next()->timestamp, 1 / 30.0, 1e-12);
  ASSERT_EQ(source->notes().size(), 1U);
  EXPECT_NE(source->notes()[0].find("has no times"), std::string::npos);
}

TEST(SensFile, ReadsWhatIsWholeOfATruncatedFile) {
  const TestFolder folder;
  const std::string whole = make_sens(3);
  folder.write("a.sens", whole.substr(0, whole.size() - 40));
  const auto source = open_source(folder / "a.sens");
  EXPECT_EQ(source->frame_count(), 2);
  ASSERT_EQ(source->notes().size(), 1U);
  EXPECT_NE(source->notes()[0].find("ends too early: 2 of 3 frames are whole"), std::string::npos);
}

TEST(SensFile, RefusesWhatIsNone) {
  const std::string whole = make_sens(1);
  const auto with = [&](std::size_t at, std::uint32_t value) {
    std::string text = whole;
    std::memcpy(text.data() + at, &value, 4);
    return text;
  };
  constexpr std::size_t kCalibration = 4 + 8 + 9, kCompression = kCalibration + 4 * 64;
  EXPECT_NE(index_message("").find("a.sens: ends within its head"), std::string::npos);
  EXPECT_NE(index_message(with(0, 5)).find("is no .sens file of version 4 (but of 5)"), std::string::npos);
  EXPECT_NE(index_message(with(8, 0xffffffff)).find("ends within its head"), std::string::npos);
  EXPECT_NE(index_message(with(kCompression, 9)).find("unknown compression (9 and 1)"), std::string::npos);
  EXPECT_NE(index_message(with(kCompression + 8, 1000000)).find("1000000 x 64 pixels"), std::string::npos);
  EXPECT_NE(index_message(whole.substr(0, kCompression + 30)).find("ends within its head"),
            std::string::npos);
  EXPECT_NE(index_message(whole.substr(0, whole.size() - 100)).find("holds no frame"), std::string::npos);
}

TEST(SensFile, NamesTheFrameAtFault) {
  const TestFolder folder;
  std::string text = make_sens(1);
  text[text.size() - 20] = static_cast<char>(~text[text.size() - 20]);
  folder.write("a.sens", text);
  const auto source = open_source(folder / "a.sens");
  const auto frame = source->next();
  EXPECT_NE(message_of([&] { frame->images->depth({}); }).find("a.sens (frame 0) (depth): is damaged"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              frame->images->colour({320, 240}, ColourMode::grey);
            }).find("is 80 x 64 pixels, but"),
            std::string::npos);
}

}  // namespace
}  // namespace stdc
