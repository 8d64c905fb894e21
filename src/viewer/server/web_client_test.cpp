#include "viewer/server/web_client.hpp"

#include <gtest/gtest.h>

#include <future>

namespace stdc {
namespace {

TEST(WebClient, APageHasAPieceOnlyWhenTheLineHasTakenIt) {
  ViewBoard board;
  board.post(ViewTopic::state, "state");
  std::promise<void> under_way, done;
  std::promise<void> line_is_free;
  std::atomic<int> sent = 0, told = 0;
  WebClient::Line line;
  line.send = [&](const std::string&) {
    if (sent++ > 0) return true;
    under_way.set_value();
    line_is_free.get_future().wait();
    return true;
  };
  line.done = [&] {
    if (told++ == 0) done.set_value();
  };
  const WebClient client(board, std::move(line));
  under_way.get_future().wait();
  EXPECT_TRUE(client.feed().up_to_date());
  EXPECT_FALSE(client.up_to_date());
  line_is_free.set_value();
  done.get_future().wait();
  EXPECT_TRUE(client.up_to_date());
}

}  // namespace
}  // namespace stdc
