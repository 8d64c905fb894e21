#include "segmentation/frame_masks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/files/test_folder.hpp"

namespace stdc {
namespace {

using test::TestFolder;

constexpr double kBegin = 1305031102.175304;

/// Frames 33 ms apart, whose images are named like this.
template <typename Name>
std::vector<MaskedFrame> frames_named(int count, const Name& name) {
  std::vector<MaskedFrame> frames;
  for (int i = 0; i < count; ++i) frames.push_back({kBegin + 0.033 * i, name(i), i});
  return frames;
}

std::vector<MaskedFrame> frames_without_names(int count) {
  return frames_named(count, [](int) { return ""; });
}

/// The stems of the masks, each with the number of the frame that it was given to.
std::string pairs(const FrameMasks& found) {
  std::string text;
  for (const MaskFile& mask : found.masks) {
    text += fmt::format("{}={} ", std::lround((mask.timestamp - kBegin) / 0.033), mask.path.stem().string());
  }
  return text;
}

TEST(FrameMasks, AreFoundByTheNameOfTheColourImage) {
  const TestFolder folder;
  for (const char* name : {"left_b", "left_a", "else"})
    folder.write(fmt::format("{}.png", name), std::string());
  const auto frames =
      frames_named(3, [](int i) { return std::string("left_") + static_cast<char>('a' + i); });
  const FrameMasks found = find_frame_masks(folder.path(), frames);
  EXPECT_EQ(pairs(found), "0=left_a 1=left_b ");
  EXPECT_EQ(found.files, 3);
  EXPECT_EQ(found.found_by, "the name of the colour image");
}

TEST(FrameMasks, AreFoundByTimesOfAnyPrecision) {
  const TestFolder folder;
  for (const char* name : {"1305031102.175304001", "1305031102.21", "1305031102241304000", "1305031102274304",
                           "1305031102307", "1305031102.5"}) {
    folder.write(fmt::format("{}.png", name), std::string());
  }
  const FrameMasks found = find_frame_masks(folder.path(), frames_without_names(5));
  EXPECT_EQ(
      pairs(found),
      "0=1305031102.175304001 1=1305031102.21 2=1305031102241304000 3=1305031102274304 4=1305031102307 ");
  EXPECT_EQ(found.found_by, "time");
}

TEST(FrameMasks, AreFoundByNumbers) {
  const TestFolder folder;
  for (int i = 1; i <= 4; ++i) folder.write(fmt::format("from_one/mask_{:04d}.png", i), std::string());
  for (int i = 0; i < 4; i += 3) folder.write(fmt::format("from_zero/{:06d}.png", i), std::string());
  const FrameMasks one = find_frame_masks(folder / "from_one", frames_without_names(4));
  EXPECT_EQ(pairs(one), "0=mask_0001 1=mask_0002 2=mask_0003 3=mask_0004 ");
  EXPECT_EQ(one.found_by, "number, counted from 1");
  const FrameMasks zero = find_frame_masks(folder / "from_zero", frames_without_names(4));
  EXPECT_EQ(pairs(zero), "0=000000 3=000003 ");
  EXPECT_EQ(zero.found_by, "number, counted from 0");
}

TEST(FrameMasks, NumbersAreThoseOfTheWholeSequence) {
  const TestFolder folder;
  for (int i = 0; i < 9; ++i) folder.write(fmt::format("{}.png", i), std::string());
  auto frames = frames_without_names(9);
  frames.erase(frames.begin(), frames.begin() + 7);
  EXPECT_EQ(pairs(find_frame_masks(folder.path(), frames)), "7=7 8=8 ");
}

TEST(FrameMasks, WholeSecondsAreTimesWhereTheyFit) {
  const TestFolder folder;
  std::vector<MaskedFrame> frames;
  for (int i = 0; i < 4; ++i) {
    frames.push_back({5.0 + i, "", i});
    folder.write(fmt::format("{}.png", 5 + i), std::string());
  }
  const FrameMasks found = find_frame_masks(folder.path(), frames);
  EXPECT_EQ(found.found_by, "time");
  EXPECT_EQ(found.masks.size(), 4U);
}

TEST(FrameMasks, OfAListAreFoundByItsTimes) {
  const TestFolder folder;
  folder.write("mask.txt", fmt::format("{:.6f} a.png\n{:.6f} b.png\n", kBegin, kBegin + 10));
  const FrameMasks found = find_frame_masks(folder.path(), frames_without_names(2));
  EXPECT_EQ(pairs(found), "0=a ");
  EXPECT_EQ(found.files, 2);
}

TEST(FrameMasks, MayBeNone) {
  const TestFolder folder;
  folder.write("17.png", std::string());
  folder.write("5.000000.png", std::string());
  EXPECT_TRUE(find_frame_masks(folder.path(), frames_without_names(3)).masks.empty());
  EXPECT_THROW(find_frame_masks(folder / "none", frames_without_names(3)), Error);
}

}  // namespace
}  // namespace stdc
