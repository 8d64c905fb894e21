#include "input/open_source.hpp"

#include <gtest/gtest.h>

#include "core/files/test_folder.hpp"
#include "input/camera_file.hpp"
#include "input/frame_decoder.hpp"
#include "input/test_layouts.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;

TEST(OpenSource, FindsATumFolder) {
  const TestFolder folder;
  test::write_tum_folder(folder, "s", 3);
  const auto source = open_source(folder / "s");
  EXPECT_EQ(source->kind(), "tum");
  EXPECT_EQ(source->frame_count(), 3);
  ASSERT_TRUE(source->cameras());
  const FrameDecoder decoder(*source->cameras());
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < 3; ++i) {
      const auto frame = source->next();
      ASSERT_TRUE(frame);
      EXPECT_EQ(frame->name, std::to_string(i));
      EXPECT_EQ(decoder.decode(*frame, ColourMode::as_stored).depth.at<std::uint16_t>(3, 3), 5000 + i);
    }
    EXPECT_FALSE(source->next());
    source->rewind();
  }
}

TEST(OpenSource, HandsOutColourAsItIsStored) {
  const TestFolder folder;
  test::write_tum_folder(folder, "s", 1);
  const std::vector<std::uint8_t> jpeg = encode_jpeg(test::layout_colour(3));
  folder.write("s/rgb/0.png", jpeg);  // whatever its name says
  EXPECT_EQ(open_source(folder / "s")->next()->images->colour_file(), jpeg);
}

TEST(OpenSource, SaysWhatItCannotOpen) {
  const TestFolder folder;
  folder.write("a.xyz", std::string("?"));
  EXPECT_NE(message_of([&] { open_source(folder / "a.xyz"); }).find("a.xyz: is no recording of a kind"),
            std::string::npos);
  EXPECT_NE(message_of([&] { open_source(folder / "none"); }).find("there is no such folder"),
            std::string::npos);
  EXPECT_NE(message_of([&] { open_source(folder.path()); }).find("rgb.txt: cannot be opened"),
            std::string::npos);
}

TEST(OpenSource, RefusesOptionsThatTheKindDoesNotTake) {
  const TestFolder folder;
  test::write_tum_folder(folder, "s", 1);
  SourceOptions options;
  options.colour_topic = "/camera/color/image_raw";
  EXPECT_NE(
      message_of([&] { open_source(folder / "s", options); }).find("of the kind tum, which has no topics"),
      std::string::npos);
  options = {};
  options.kind = "none";
  EXPECT_NE(
      message_of([&] { open_source(folder / "s", options); }).find("--input-kind: there is no kind 'none'"),
      std::string::npos);
}

}  // namespace
}  // namespace stdc
