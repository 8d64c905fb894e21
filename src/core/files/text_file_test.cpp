#include "core/files/text_file.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/files/test_folder.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;

TEST(LineReader, LeavesOutBlankLinesAndCommentsAndCountsThem) {
  LineReader lines("\xEF\xBB\xBF# head\n\n  one two \r\n\t# no\nthree");
  std::string_view line;
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "one two");
  EXPECT_EQ(lines.number(), 3);
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "three");
  EXPECT_EQ(lines.number(), 5);
  EXPECT_FALSE(lines.next(line));
  EXPECT_FALSE(LineReader("").next(line));
}

TEST(SplitWords, SplitsAtBlanksAndTabs) {
  EXPECT_EQ(split_words("a \t bc  d"), (std::vector<std::string_view>{"a", "bc", "d"}));
  EXPECT_TRUE(split_words("").empty());
}

TEST(ParseNumber, TakesWholeNumbersOnly) {
  EXPECT_EQ(parse_number("1305031102.175304"), 1305031102.175304);
  EXPECT_EQ(parse_number("-1e-3"), -1e-3);
  EXPECT_EQ(parse_number("+2"), 2);
  EXPECT_TRUE(std::isnan(*parse_number("nan")));
  for (const char* word : {"", "+", "1,5", "1.5x", "0x10", "--1", "+-1", "1e999", " 1", "one"}) {
    EXPECT_FALSE(parse_number(word)) << word;
  }
}

TEST(ParseTimestamp, NoticesOtherUnits) {
  EXPECT_EQ(parse_timestamp("12.5", "a:1"), 12.5);
  EXPECT_NE(message_of([] { parse_timestamp("1403636579763555584", "a:1"); }).find("nanoseconds"),
            std::string::npos);
  EXPECT_EQ(message_of([] { parse_timestamp("nan", "a:1"); }),
            "a:1: the timestamp 'nan' is not a finite number; give the time in seconds");
}

TEST(ReadFile, ReadsAllBytes) {
  const TestFolder folder;
  const std::string bytes("a\0b\n", 4);
  EXPECT_EQ(read_file(folder.write("x", bytes), "hint"), bytes);
  EXPECT_EQ(read_file(folder.write("empty", std::string()), "hint"), "");
  const std::string large(300000, 'x');
  EXPECT_EQ(read_file(folder.write("large", large), "hint"), large);
  EXPECT_NE(message_of([&] { read_file(folder / "large", "hint", 1000); }).find("larger than 1000"),
            std::string::npos);
}

TEST(ReadFile, NamesWhatIsMissing) {
  const TestFolder folder;
  EXPECT_EQ(message_of([&] { read_file(folder / "none", "look again"); }),
            (folder / "none").string() + ": cannot be opened (No such file or directory); look again");
  EXPECT_NE(message_of([&] { read_file(folder.path(), "m"); }).find("is a folder"), std::string::npos);
}

TEST(Shown, IsShortAndOnOneLine) {
  EXPECT_EQ(shown("a\nb"), "'a?b'");
  EXPECT_EQ(shown(std::string(100, 'x')).size(), 45U);
}

}  // namespace
}  // namespace stdc
