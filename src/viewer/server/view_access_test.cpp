#include "viewer/server/view_access.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

TEST(ViewAccess, OnLoopbackTheMachinesOwnNamesAreTaken) {
  const ViewAccess access("");
  for (const char* host : {"localhost", "localhost:8080", "127.0.0.1:8080", "127.1.2.3", "[::1]:8080"}) {
    EXPECT_FALSE(access.refuse_page({host, {}, ""})) << host;
  }
  for (const char* host :
       {"evil.example:8080", "192.168.1.5:8080", "127.0.0.1.evil.example", "localhost.evil.example", "",
        "local host", "localhost\r\nX: y", "127.0.0.1@evil.example", "127.evil"}) {
    EXPECT_TRUE(access.refuse_page({host, {}, ""})) << host;
  }
  EXPECT_TRUE(access.refuse_page({std::nullopt, {}, ""}));
}

TEST(ViewAccess, OnlyItsOwnPageMayConnect) {
  const ViewAccess access("");
  EXPECT_FALSE(access.refuse_connection({"localhost:8080", "http://localhost:8080", ""}));
  EXPECT_FALSE(
      access.refuse_connection({"localhost:9000", "http://localhost:9000", ""}));  // through a tunnel
  for (const char* origin : {"http://evil.example", "http://localhost:8081", "http://localhost", "null", "",
                             "http://localhost:8080.evil.example", "ftp://localhost:8080"}) {
    EXPECT_TRUE(access.refuse_connection({"localhost:8080", origin, ""})) << origin;
  }
  EXPECT_TRUE(access.refuse_connection({"localhost:8080", std::nullopt, ""}));
  EXPECT_TRUE(access.refuse_connection({"evil.example", "http://evil.example", ""}));
}

TEST(ViewAccess, ElsewhereTheTokenIsAskedFor) {
  const ViewAccess access("0123456789abcdef");
  EXPECT_FALSE(access.refuse_page({"robot.local:8080", {}, "token=0123456789abcdef"}));
  EXPECT_FALSE(access.refuse_page({"192.168.1.5:8080", {}, "a=b&token=0123456789abcdef&c"}));
  for (const char* query : {"", "token=", "token=0123456789abcdee", "token=0123456789abcdef0",
                            "xtoken=0123456789abcdef", "token", "&&&", "token=0123456789abcde"}) {
    EXPECT_TRUE(access.refuse_page({"robot.local:8080", {}, query})) << query;
  }
  EXPECT_TRUE(
      access.refuse_connection({"robot.local:8080", "http://evil.example", "token=0123456789abcdef"}));
  EXPECT_FALSE(
      access.refuse_connection({"robot.local:8080", "http://robot.local:8080", "token=0123456789abcdef"}));
}

TEST(ViewAccess, TokensAreLongAndDiffer) {
  const std::string token = make_view_token();
  EXPECT_EQ(token.size(), 32U);
  EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(token, make_view_token());
}

}  // namespace
}  // namespace stdc
