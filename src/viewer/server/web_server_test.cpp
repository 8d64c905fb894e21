#include "viewer/server/web_server.hpp"

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "core/error.hpp"
#include "viewer/server/test_web.hpp"

namespace stdc {
namespace {

using test::ask;
using test::frame;
using test::get;
using test::Line;
using test::upgrade;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Waits for something that another thread does.
template <typename Condition>
bool soon(Condition condition) {
  for (int i = 0; i < 1000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return condition();
}

class WebServerTest : public ::testing::Test {
 protected:
  WebServer::Handlers handlers() {
    return {
        [this](const ViewRequest& request) { requests_ += request.kind == ViewRequest::Kind::pause ? 1 : 0; },
        [](std::uint32_t) { return std::make_shared<const std::string>("keyframe"); }};
  }
  std::unique_ptr<Line> connect(int port) const {
    auto line = std::make_unique<Line>(port);
    line->send(upgrade());
    EXPECT_TRUE(contains(line->receive_head(), "101 Switching Protocols"));
    return line;
  }

  ViewBoard board_;
  std::atomic<int> requests_ = 0;
};

TEST_F(WebServerTest, GivesThePageAndNothingElse) {
  const WebServer server({"127.0.0.1", 0}, ViewAccess(""), board_, handlers());
  const std::string page = get(server.port(), "/");
  EXPECT_TRUE(contains(page, "200 OK"));
  EXPECT_TRUE(contains(page, "<!doctype html>"));
  EXPECT_TRUE(contains(page, "Content-Security-Policy: default-src 'none'"));
  EXPECT_TRUE(contains(get(server.port(), "/viewer.js"), "text/javascript"));
  EXPECT_TRUE(contains(get(server.port(), "/viewer.css"), "text/css"));
  for (const char* path : {"/etc/passwd", "/../../etc/passwd", "/%2e%2e/etc/passwd", "/viewer.js/",
                           "/viewer.map", "/index.htm", "/live"}) {
    const std::string answer = get(server.port(), path);
    EXPECT_FALSE(contains(answer, "200 OK")) << path << "\n" << answer;
    EXPECT_FALSE(contains(answer, "root:")) << path;
  }
  EXPECT_TRUE(contains(
      ask(server.port(), "POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\n\r\nabc"), "405"));
  EXPECT_TRUE(contains(ask(server.port(), "HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\n"), "200 OK"));
}

TEST_F(WebServerTest, RefusesOtherNamesAndOtherPages) {
  const WebServer server({"127.0.0.1", 0}, ViewAccess(""), board_, handlers());
  EXPECT_TRUE(contains(get(server.port(), "/", "evil.example"), "403"));
  EXPECT_FALSE(contains(ask(server.port(), upgrade("evil.example")), "101 Switching"));
  EXPECT_FALSE(contains(ask(server.port(), upgrade("localhost", "http://evil.example")), "101 Switching"));
  EXPECT_EQ(server.connections(), 0);
}

TEST_F(WebServerTest, WithATokenOnlyTheLinkOpens) {
  const WebServer server({"127.0.0.1", 0}, ViewAccess("secret"), board_, handlers());
  EXPECT_TRUE(contains(get(server.port(), "/", "robot:1"), "403"));
  EXPECT_TRUE(contains(get(server.port(), "/?token=wrong", "robot:1"), "403"));
  EXPECT_TRUE(contains(get(server.port(), "/?token=secret", "robot:1"), "200 OK"));
  EXPECT_TRUE(contains(get(server.port(), "/viewer.js", "robot:1"), "200 OK"));  // it is no secret
  const int port = server.port();
  EXPECT_FALSE(contains(ask(port, upgrade("robot", "-", "/live")), "101 Switching"));
  const Line line(port);
  line.send(upgrade("robot", "-", "/live?token=secret"));
  EXPECT_TRUE(contains(line.receive_head(), "101 Switching"));
}

TEST_F(WebServerTest, SendsWhatIsOnTheBoardAndTakesRequests) {
  const WebServer server({"127.0.0.1", 0}, ViewAccess(""), board_, handlers());
  board_.post(ViewTopic::state, "what is so");
  board_.post(ViewTopic::map, "the map");
  const auto line = connect(server.port());
  EXPECT_TRUE(contains(line->receive(20), "what is so"));
  line->send(frame("want 8"));
  EXPECT_TRUE(contains(line->receive(20), "the map"));
  EXPECT_EQ(server.wanted(), 8U);
  line->send(frame("keyframe 3"));
  EXPECT_TRUE(contains(line->receive(20), "keyframe"));
  line->send(frame("pause"));
  EXPECT_TRUE(soon([this] { return requests_ == 1; }));
  line->send(frame("hello", 9));  // a ping
  EXPECT_TRUE(contains(line->receive(5), "hello"));
}

TEST_F(WebServerTest, EndsAConnectionThatSendsGarbage) {
  const WebServer server({"127.0.0.1", 0}, ViewAccess(""), board_, handlers());
  const std::string huge = std::string("\x82\xff\x7f\xff\xff\xff\xff\xff\xff\xff", 10) + std::string(4, '\0');
  // All at once: it waits some seconds for the rest of what is cut off.
  std::vector<std::unique_ptr<Line>> lines;
  for (const std::string& bytes :
       {frame("nonsense"), frame(std::string(60000, 'a')), frame("want 7", 2), frame("", 8),
        frame("want 7", 0), frame("want 7", 3), huge, std::string("\x01\x81\0\0\0\0p", 7)}) {
    lines.push_back(connect(server.port()));
    lines.back()->send(bytes);
  }
  for (const auto& line : lines) EXPECT_TRUE(line->ended());
  EXPECT_TRUE(soon([&server] { return server.clients() == 0; }));
  lines.clear();
  for (const std::string& bytes :
       {std::string("\r\n\r\n"), std::string(100000, 'A'), std::string(3000, '\0'),
        "GET / HTTP/1.1\r\nHost: " + std::string(20000, 'h') + "\r\n\r\n",
        std::string("GET  HTTP/9.9\r\n\r\n"), std::string("\x16\x03\x01\x02\0", 5)}) {
    lines.push_back(std::make_unique<Line>(server.port(), 10));
    lines.back()->send(bytes);
  }
  for (const auto& line : lines) EXPECT_FALSE(contains(line->receive(1000000), "200 OK"));
  EXPECT_TRUE(contains(get(server.port(), "/"), "200 OK"));
}

TEST_F(WebServerTest, EndsAConnectionByTheHeadOfALongMessage) {
  const WebServer server({"127.0.0.1", 0}, ViewAccess(""), board_, handlers());
  const auto line = connect(server.port());
  line->send(std::string_view("\x81\xff\0\0\0\0\x7f\xff\0\0\0\0\0\0", 14));  // 2 GB will follow
  constexpr std::size_t kPiece = std::size_t{1} << 20U, kMost = 256;
  const std::string piece(kPiece, 'a');
  std::size_t taken = 0;
  while (taken < kMost && line->send(piece)) ++taken;
  EXPECT_LT(taken, kMost);  // what the two sockets hold
  EXPECT_TRUE(soon([&server] { return server.clients() == 0; }));
}

TEST_F(WebServerTest, TellsWhyItEndsAConnection) {
  const WebServer server({"127.0.0.1", 0}, ViewAccess(""), board_, handlers());
  for (const auto& [bytes, code] :
       {std::pair{frame(std::string(1000, 'a')), 1009}, std::pair{frame("nonsense"), 1008},
        std::pair{frame("a", 0), 1002}, std::pair{frame("", 8), 1000}}) {
    const auto line = connect(server.port());
    line->send(bytes);
    const std::string end = {'\x88', 2, static_cast<char>(code >> 8), static_cast<char>(code & 0xFF)};
    EXPECT_TRUE(contains(line->receive(4), end)) << code;
    EXPECT_TRUE(line->ended());
  }
}

TEST_F(WebServerTest, SaysGoodbyeOnce) {
  auto server = std::make_unique<WebServer>(WebAddress{"127.0.0.1", 0}, ViewAccess(""), board_, handlers());
  const auto line = connect(server->port());
  EXPECT_TRUE(soon([&server] { return server->clients() == 1; }));
  auto ending = std::async(std::launch::async, [&server] { server.reset(); });
  const std::string goodbye("\x88\x02\x03\xe9", 4);
  EXPECT_EQ(line->receive(4), goodbye);
  line->send(frame(goodbye.substr(2), 8));
  EXPECT_EQ(line->receive(1), "");
}

TEST_F(WebServerTest, TakesAsManyPagesAsItHasThreadsFor) {
  const WebServer server({"127.0.0.1", 0}, ViewAccess(""), board_, handlers());
  board_.post(ViewTopic::state, "state");
  std::vector<std::unique_ptr<Line>> lines;
  for (int i = 0; i < WebServer::kMaxClients; ++i) lines.push_back(connect(server.port()));
  EXPECT_TRUE(soon([&server] { return server.clients() == WebServer::kMaxClients; }));
  EXPECT_FALSE(contains(ask(server.port(), upgrade()), "101 Switching"));
  EXPECT_TRUE(contains(get(server.port(), "/"), "200 OK"));
  lines.pop_back();
  EXPECT_TRUE(soon([&server] { return server.clients() < WebServer::kMaxClients; }));
  lines.push_back(connect(server.port()));
}

TEST_F(WebServerTest, ConnectionsThatAreOpenedAndDroppedLeaveNothingBehind) {
  const WebServer server({"127.0.0.1", 0}, ViewAccess(""), board_, handlers());
  constexpr int kCount = 10000;
  int refused = 0;
  for (int i = 0; i < kCount; ++i) {
    const Line line(server.port());
    refused += line.connected() ? 0 : 1;
    if (i % 3 == 1) line.send("GET / HTTP/1.1\r\nHo");
    if (i % 100 == 2) line.send(upgrade());
  }
  EXPECT_EQ(refused, 0);
  EXPECT_TRUE(contains(get(server.port(), "/"), "200 OK"));
  EXPECT_TRUE(soon([&server] { return server.clients() == 0; }));
}

TEST_F(WebServerTest, APageThatTakesNothingHoldsUpNobody) {
  auto server = std::make_unique<WebServer>(WebAddress{"127.0.0.1", 0}, ViewAccess(""), board_, handlers());
  const auto stuck = connect(server->port());
  stuck->send(frame("want 31"));
  EXPECT_TRUE(soon([&server] { return server->wanted() == 31; }));
  for (int i = 0; i < 40; ++i) board_.post(ViewTopic::mesh, std::string(std::size_t{1} << 20U, 'm'));
  const auto other = connect(server->port());
  board_.post(ViewTopic::state, "state");
  EXPECT_TRUE(contains(other->receive(20), "state"));
  const auto begin = std::chrono::steady_clock::now();
  server.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(8));
}

TEST_F(WebServerTest, APortThatIsTakenIsSaid) {
  const WebServer server({"127.0.0.1", 0}, ViewAccess(""), board_, handlers());
  try {
    const WebServer second({"127.0.0.1", server.port()}, ViewAccess(""), board_, handlers());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.problem(), fmt::format("port {} is taken", server.port()));
  }
  EXPECT_THROW(WebServer({"no address", 0}, ViewAccess(""), board_, handlers()), Error);
  EXPECT_THROW(WebServer({"8.8.8.8", 0}, ViewAccess(""), board_, handlers()), Error);
}

}  // namespace
}  // namespace stdc
