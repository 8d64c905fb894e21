#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "run/test_sequence.hpp"

namespace stdc::app {

namespace fs = std::filesystem;
using stdc::test::TestFolder;

inline std::string content(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

struct Outcome {
  int code = -1;
  std::string out, err;
};

/// A folder with a sequence "s" of 12 frames in it, and the program.
class CommandLine : public ::testing::Test {
 protected:
  Outcome call(const std::string& arguments) const {
    const std::string command =
        fmt::format("cd {} && {} {} > .out 2> .err", folder_.path().string(), STDC_PROGRAM, arguments);
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(folder_ / ".out"),
            content(folder_ / ".err")};
  }
  void make_sequence(int frames = 12) const { stdc::test::write_test_sequence(folder_, "s", frames); }
  /// Expects exit code 2, one line with `part` in it, and no results.
  void expect_refusal(const std::string& arguments, const std::string& part) const {
    const Outcome outcome = call(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, part)) << outcome.err << "has no\n" << part;
    EXPECT_TRUE(contains(outcome.err, "; ")) << "no hint: " << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(fs::exists(folder_ / "o"));
  }

  TestFolder folder_;
};

}  // namespace stdc::app
