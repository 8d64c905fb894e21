#include "viewer/server/web_socket_reader.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "viewer/server/test_web.hpp"

namespace stdc {
namespace {

using Kind = WebSocketReader::Kind;
using test::frame;

constexpr std::size_t kMax = 300;

/// A frame that is not the last of its message.
std::string first_frame(std::string_view text, std::uint8_t opcode = 1) {
  std::string bytes = frame(text, opcode);
  bytes[0] = static_cast<char>(opcode);
  return bytes;
}

TEST(WebSocketReader, TakesMessagesHoweverTheyAreCut) {
  const std::string bytes = frame("want 7") + frame(std::string(200, 'a')) + frame("hello", 9) + frame("", 2);
  for (const std::size_t piece : {1, 2, 3, 7, 1000}) {
    WebSocketReader reader(kMax);
    std::vector<WebSocketReader::Message> messages;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      reader.add(std::string_view(bytes).substr(at, piece));
      while (auto message = reader.next()) messages.push_back(std::move(*message));
    }
    ASSERT_EQ(messages.size(), 4U);
    EXPECT_EQ(messages[0].kind, Kind::text);
    EXPECT_EQ(messages[0].content, "want 7");
    EXPECT_EQ(messages[1].content, std::string(200, 'a'));
    EXPECT_EQ(messages[2].kind, Kind::ping);
    EXPECT_EQ(messages[2].content, "hello");
    EXPECT_EQ(messages[3].kind, Kind::binary);
    EXPECT_FALSE(reader.is_waiting());
    EXPECT_FALSE(reader.refusal());
  }
}

TEST(WebSocketReader, UnmasksTheContent) {
  WebSocketReader reader(kMax);
  reader.add(std::string_view("\x81\x85\x37\xfa\x21\x3d\x7f\x9f\x4d\x51\x58", 11));  // RFC 6455, 5.7
  const auto message = reader.next();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->content, "Hello");
}

TEST(WebSocketReader, JoinsFragmentsAndTakesPingsBetweenThem) {
  WebSocketReader reader(kMax);
  reader.add(first_frame("wa") + frame("ping", 9) + first_frame("n", 0) + frame("t 7", 0) + frame("pause"));
  EXPECT_EQ(reader.next()->kind, Kind::ping);
  EXPECT_EQ(reader.next()->content, "want 7");
  EXPECT_EQ(reader.next()->content, "pause");
  reader.add(first_frame("wa"));
  EXPECT_FALSE(reader.next());
  EXPECT_TRUE(reader.is_waiting());
}

TEST(WebSocketReader, RefusesALongMessageByItsHead) {
  const std::string head_of_4_gb("\x82\xff\x00\x00\x00\x00\xff\xff\xff\xff\0\0\0\0", 14);
  const std::string head_of_most("\x82\xff\xff\xff\xff\xff\xff\xff\xff\xff\0\0\0\0", 14);
  for (const std::string& bytes :
       {head_of_4_gb, head_of_most, frame(std::string(kMax + 1, 'a'), 2).substr(0, 8),
        first_frame(std::string(kMax, 'a')) + frame("a", 0)}) {
    WebSocketReader reader(kMax);
    reader.add(bytes);
    EXPECT_FALSE(reader.next());
    EXPECT_EQ(reader.refusal(), CloseCode::too_large);
    reader.add(std::string(100000, 'a'));
    EXPECT_FALSE(reader.next());
    EXPECT_EQ(reader.size(), 0U);
  }
  WebSocketReader reader(kMax);
  reader.add(frame(std::string(kMax, 'a')));
  EXPECT_EQ(reader.next()->content.size(), kMax);
}

TEST(WebSocketReader, RefusesWhatTheProtocolForbids) {
  const std::string unmasked("\x81\x01p", 3), reserved_bit("\xc1\x81\0\0\0\0p", 7);
  const std::string long_ping("\x89\xfe", 2), cut_ping("\x09\x80", 2);
  for (const std::string& bytes : {unmasked, reserved_bit, long_ping, cut_ping, frame("a", 0), frame("a", 3),
                                   frame("a", 11), first_frame("a") + frame("b")}) {
    WebSocketReader reader(kMax);
    reader.add(bytes);
    EXPECT_FALSE(reader.next());
    EXPECT_EQ(reader.refusal(), CloseCode::protocol_error);
  }
}

}  // namespace
}  // namespace stdc
