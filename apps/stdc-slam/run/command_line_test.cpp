#include "run/command_line.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace stdc::app {
namespace {

TEST(ShellCommand, QuotesWhatAShellWouldRead) {
  EXPECT_EQ(shell_command({"stdc-slam", "run", "a/b.txt", "--set", "x.y=1"}),
            "stdc-slam run a/b.txt --set x.y=1");
  EXPECT_EQ(shell_command({"a b", "", "it's", "$x;`y`"}), R"x('a b' '' 'it'\''s' '$x;`y`')x");
  EXPECT_EQ(shell_command({"caf\xc3\xa9"}), "'caf\xc3\xa9'");
  EXPECT_EQ(shell_command({"caf\xe9\n'\\"}), R"x($'caf\xe9\x0a\'\\')x");
}

TEST(ShellCommand, ComesBackFromABash) {
  std::string all;
  for (int c = 1; c < 256; ++c) all += static_cast<char>(c);
  const std::string command = "bash -c " + shell_command({"printf %s " + shell_command({all})});
  std::FILE* pipe = popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string back(1000, '\0');
  back.resize(std::fread(back.data(), 1, back.size(), pipe));
  EXPECT_EQ(pclose(pipe), 0);
  EXPECT_EQ(back, all);
}

TEST(ProcessArguments, BeginWithTheProgram) {
  ASSERT_FALSE(process_arguments().empty());
  EXPECT_NE(process_arguments().front().find("stdc_app_test"), std::string::npos);
  EXPECT_NE(machine_name().find("core"), std::string::npos);
}

}  // namespace
}  // namespace stdc::app
