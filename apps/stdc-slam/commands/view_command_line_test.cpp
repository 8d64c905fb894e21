// The live view as a user meets it: run --view.
#include <cstdio>
#include <thread>

#include "commands/test_command_line.hpp"
#include "viewer/server/test_web.hpp"

namespace stdc::app {
namespace {

constexpr const char* kViewRun = "run s -o o --segmentation off --motion off";
constexpr int kNotInstalled = 3;

class ViewCommandLine : public CommandLine {
 protected:
  /// Runs a script of the repository; its exit code.
  int script(const std::string& call) const {
    const int status = std::system(fmt::format("cd {} && {}/scripts/{} > .out 2> .err",
                                               folder_.path().string(), STDC_SOURCE_FOLDER, call)
                                       .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string said() const { return content(folder_ / ".out") + content(folder_ / ".err"); }
};

TEST_F(ViewCommandLine, APageChangesNothingAndSeesTheRun) {
  make_sequence();
  ASSERT_EQ(call(fmt::format("{} --quiet", kViewRun)).code, 0);
  const std::string expected = content(folder_ / "o/trajectory.txt");
  const std::string command =
      fmt::format("cd {} && {} {} --quiet --view 0 --view-wait --view-address 127.0.0.1 2>&1",
                  folder_.path().string(), STDC_PROGRAM, kViewRun);
  std::FILE* run = popen(command.c_str(), "r");
  ASSERT_NE(run, nullptr);
  char text[200] = "";
  ASSERT_NE(std::fgets(text, sizeof text, run), nullptr);
  int port = 0;
  ASSERT_EQ(std::sscanf(text, "stdc-slam: live view at http://localhost:%d/", &port), 1) << text;
  const stdc::test::Line line(port);
  line.send(stdc::test::upgrade());
  EXPECT_TRUE(contains(line.receive_head(), "101 Switching"));
  line.send(stdc::test::frame("want 31"));
  const std::string seen = line.receive(std::size_t{1} << 30U);  // to its end
  EXPECT_TRUE(contains(seen, "\"finished\":true"));
  EXPECT_EQ(pclose(run), 0);
  EXPECT_EQ(content(folder_ / "o/trajectory.txt"), expected);
}

TEST_F(ViewCommandLine, BadInputIsOneLineBeforeTheRunBegins) {
  make_sequence();
  const int taken = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(::bind(taken, reinterpret_cast<const sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(taken, 1), 0);
  ASSERT_EQ(::getsockname(taken, reinterpret_cast<sockaddr*>(&address), &size), 0);
  const int port = ntohs(address.sin_port);
  expect_refusal(fmt::format("{} --view {}", kViewRun, port), fmt::format("port {} is taken", port));
  ::close(taken);
  expect_refusal(fmt::format("{} --view 70000", kViewRun), "70000 is not a port");
  expect_refusal(fmt::format("{} --view 0 --view-address nowhere", kViewRun), "cannot listen on nowhere");
  expect_refusal(fmt::format("{} --view-address 0.0.0.0", kViewRun), "--view");
  expect_refusal(fmt::format("{} --view-wait", kViewRun), "--view");
}

TEST_F(ViewCommandLine, TheWordAfterTheOptionIsNoPort) {
  make_sequence();
  const Outcome outcome = call("run --view s -o o --frames 0:2 --segmentation off");
  // The port may be in use by somebody else.
  const bool taken = outcome.code != 0;
  EXPECT_TRUE(contains(outcome.err, taken ? "port 8080 is taken" : "live view at http://localhost:8080/"))
      << outcome.err;
}

TEST_F(ViewCommandLine, AnAddressForOthersHasAToken) {
  make_sequence();
  const Outcome outcome =
      call(fmt::format("{} --frames 0:2 --quiet --view 0 --view-address 0.0.0.0", kViewRun));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.err, "/?token=")) << outcome.err;
}

TEST_F(ViewCommandLine, TheCommittedPageIsWhatItsSourcesGive) {
  const int code = script("build_viewer --check");
  if (code == kNotInstalled) GTEST_SKIP() << said();
  EXPECT_EQ(code, 0) << said() << "run scripts/build_viewer";
}

TEST_F(ViewCommandLine, ThePageWorksInABrowser) {
  constexpr int kFrames = 60;
  make_sequence(kFrames);
  const int code = script(fmt::format("test_viewer {} s", STDC_PROGRAM));
  if (code == kNotInstalled) GTEST_SKIP() << said();
  EXPECT_EQ(code, 0) << said();
}

}  // namespace
}  // namespace stdc::app
