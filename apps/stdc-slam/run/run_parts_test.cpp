// The small parts of the run command.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "run/frame_loader.hpp"
#include "run/frame_range.hpp"
#include "run/output_folder.hpp"
#include "run/process_usage.hpp"
#include "run/sequence_input.hpp"
#include "run/test_sequence.hpp"

namespace stdc::app {
namespace {

namespace fs = std::filesystem;
using stdc::test::message_of;
using stdc::test::TestFolder;

std::string content(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(ParseFrameRange, TakesEitherEnd) {
  EXPECT_EQ(parse_frame_range("", 10), (FrameRange{0, 10}));
  EXPECT_EQ(parse_frame_range("2:5", 10), (FrameRange{2, 5}));
  EXPECT_EQ(parse_frame_range(":5", 10), (FrameRange{0, 5}));
  EXPECT_EQ(parse_frame_range("7:", 10), (FrameRange{7, 10}));
  EXPECT_EQ(parse_frame_range(":", 10), (FrameRange{0, 10}));
}

TEST(ParseFrameRange, WithoutAKnownLength) {
  EXPECT_EQ(parse_frame_range("", {}), (FrameRange{0, {}}));
  EXPECT_EQ(parse_frame_range("7:", {}), (FrameRange{7, {}}));
  EXPECT_EQ(parse_frame_range("7:900", {}), (FrameRange{7, 900}));
  EXPECT_NE(message_of([] { parse_frame_range("7:7", {}); }).find("7:7 is empty"), std::string::npos);
}

TEST(ParseFrameRange, RefusesTheRest) {
  for (const char* text : {"3", "a:b", "3:x", "-1:4", "1:2:3", "5:5", "6:5", "0:11", "10:", "1.5:3"}) {
    EXPECT_NE(message_of([&] { parse_frame_range(text, 10); }).find("--frames: "), std::string::npos) << text;
  }
}

TEST(OutputFolder, ShowsAllAtTheEnd) {
  const TestFolder folder;
  const fs::path path = folder / "a/b/";
  OutputFolder output(path);
  output.write("one.txt", "1");
  output.write("two.txt", "22");
  EXPECT_FALSE(fs::exists(path / "one.txt"));
  output.commit();
  EXPECT_EQ(content(path / "one.txt"), "1");
  EXPECT_EQ(content(path / "two.txt"), "22");
  EXPECT_EQ(entries(path), 2U);
}

TEST(OutputFolder, LeavesNothingWithoutCommit) {
  const TestFolder folder;
  {
    OutputFolder output(folder / "a/b");
    output.write("one.txt", "1");
  }
  EXPECT_EQ(entries(folder.path()), 0U);
}

TEST(OutputFolder, KeepsWhatWasThere) {
  const TestFolder folder;
  folder.write("out/one.txt", std::string("old"));
  folder.write("out/mine.txt", std::string("mine"));
  {
    OutputFolder output(folder / "out");
    output.write("one.txt", "new");
    EXPECT_EQ(content(folder / "out/one.txt"), "old");
  }
  EXPECT_EQ(content(folder / "out/one.txt"), "old");
  EXPECT_EQ(entries(folder / "out"), 2U);
  OutputFolder output(folder / "out");
  output.write("one.txt", "new");
  output.commit();
  EXPECT_EQ(content(folder / "out/one.txt"), "new");
  EXPECT_EQ(content(folder / "out/mine.txt"), "mine");
}

TEST(OutputFolder, DropsWhatAnOlderRunHadMoreOf) {
  const TestFolder folder;
  for (const char* name : {"map-1.txt", "map-2.txt", "map-.txt", "map-2b.txt", "map-3.csv", "my-map-1.txt"}) {
    folder.write(std::string("out/") + name, std::string("old"));
  }
  OutputFolder output(folder / "out");
  output.write("map-1.txt", "new");
  output.drop_older("map-");
  EXPECT_TRUE(fs::exists(folder / "out/map-2.txt"));
  output.commit();
  EXPECT_EQ(content(folder / "out/map-1.txt"), "new");
  EXPECT_FALSE(fs::exists(folder / "out/map-2.txt"));
  EXPECT_EQ(entries(folder / "out"), 5U) << "what has another name stays";
}

TEST(OutputFolder, NamesAnUnwritablePlace) {
  const TestFolder folder;
  folder.write("file", std::string("x"));
  EXPECT_NE(message_of([&] { OutputFolder(folder / "file"); }).find("is not a folder"), std::string::npos);
  EXPECT_NE(message_of([&] { OutputFolder(folder / "file/out"); }).find("cannot be made"), std::string::npos);
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(FrameLoader, GivesAllFramesInOrder) {
  const TestFolder folder;
  stdc::test::write_test_sequence(folder, "s", 12);
  fs::resize_file(folder / "s/rgb/4.png", 50);
  const SequenceInput input({folder / "s", {}, "", {}});
  FrameLoader loader(input, ColourMode::grey, 2);
  const std::vector<double> times = input.frame_times().value();
  for (int i = 0; i < 12; ++i) {
    const auto frame = loader.next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->index, i);
    EXPECT_EQ(frame->timestamp, times[static_cast<std::size_t>(i)]);
    EXPECT_EQ(frame->image.has_value(), i != 4);
    EXPECT_EQ(frame->error.has_value(), i == 4);
  }
  EXPECT_FALSE(loader.next());
  EXPECT_FALSE(loader.next());
}

TEST(FrameLoader, CanBeLeftEarly) {
  const TestFolder folder;
  stdc::test::write_test_sequence(folder, "s", 6);
  const SequenceInput input({folder / "s", {}, "2:", {}});
  { const FrameLoader untouched(input, ColourMode::as_stored); }
  FrameLoader loader(input, ColourMode::as_stored);
  const auto frame = loader.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->name, "2") << "rewound, and to the first of the chosen frames";
}

TEST(ProcessUsage, IsPlausible) {
  const ProcessUsage usage = process_usage();
  EXPECT_GE(usage.wall_seconds, 0);
  EXPECT_LT(usage.wall_seconds, 3600);
  EXPECT_GE(usage.cpu_seconds, 0);
  EXPECT_GT(usage.peak_memory_mb, 1);
}

}  // namespace
}  // namespace stdc::app
