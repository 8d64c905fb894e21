#include "input/video/child_process.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <system_error>

namespace stdc {
namespace {

std::string output_of(ChildProcess& child) {
  std::string text(1000, '\0');
  text.resize(child.read({reinterpret_cast<std::uint8_t*>(text.data()), text.size()}));
  return text;
}

/// Whether this process has children, finished or not.
bool has_children() {
  siginfo_t info{};
  return waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0 || errno != ECHILD;
}

TEST(ChildProcess, GivesOutputComplaintsAndExitStatus) {
  ChildProcess child({"sh", "-c", "echo out; echo wrong >&2; exit 3"});
  EXPECT_EQ(output_of(child), "out\n");
  EXPECT_EQ(child.finish(), 3);
  EXPECT_EQ(child.complaints(), "wrong\n");
  EXPECT_FALSE(has_children());
}

TEST(ChildProcess, WordsAreNotReadByAShell) {
  ChildProcess child({"printf", "%s|", "a b", "$HOME", "; echo", "-x"});
  EXPECT_EQ(output_of(child), "a b|$HOME|; echo|-x|");
  EXPECT_EQ(child.finish(), 0);
}

TEST(ChildProcess, HasNoInput) {
  ChildProcess child({"cat"});
  EXPECT_EQ(output_of(child), "");
  EXPECT_EQ(child.finish(), 0);
}

TEST(ChildProcess, KeepsTheStartOfManyComplaints) {
  ChildProcess child(
      {"sh", "-c", "i=0; while [ $i -lt 30000 ]; do echo word$i >&2; i=$((i+1)); done; echo done"});
  EXPECT_EQ(output_of(child), "done\n") << "it does not wait for its complaints to be read";
  EXPECT_EQ(child.finish(), 0);
  EXPECT_EQ(child.complaints().size(), 4096U);
  EXPECT_EQ(child.complaints().substr(0, 12), "word0\nword1\n");
}

TEST(ChildProcess, IsGoneWithItsObject) {
  const auto start = std::chrono::steady_clock::now();
  {
    ChildProcess endless({"sh", "-c", "while :; do echo again; done"});
    std::vector<std::uint8_t> some(100000);
    EXPECT_EQ(endless.read(some), some.size());
    ChildProcess silent({"sleep", "1000"});
  }
  EXPECT_FALSE(has_children());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(ChildProcess, IsStoppedIfItDoesNotEndWithItsOutput) {
  ChildProcess child({"sh", "-c", "echo out; exec >&-; exec sleep 1000"});
  EXPECT_EQ(output_of(child), "out\n");
  EXPECT_EQ(child.finish(), std::nullopt);
  EXPECT_FALSE(has_children());
}

TEST(ChildProcess, SaysThatThereIsNoSuchProgram) {
  try {
    ChildProcess child({"stdc-no-such-program"});
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
  }
  EXPECT_FALSE(has_children());
}

}  // namespace
}  // namespace stdc
