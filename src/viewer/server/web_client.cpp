#include "viewer/server/web_client.hpp"

#include <utility>

#include "core/give_way.hpp"

namespace stdc {

WebClient::WebClient(ViewBoard& board, Line line)
    : board_(board), line_(std::move(line)), feed_(board), thread_([this] { run(); }) {}

WebClient::~WebClient() {
  stop_ = true;
  board_.wake();
  thread_.join();
}

void WebClient::end() {
  goodbye_ = true;
  stop_ = true;
  board_.wake();
}

void WebClient::run() {
  constexpr auto kIdle = std::chrono::milliseconds(250);
  give_way();
  while (!stop_) {
    const std::uint64_t seen = board_.changes();
    sending_ = true;  // before the feed thinks that the page has it
    if (const auto piece = feed_.next_piece()) {
      if (line_.send(*piece)) continue;
      dead_ = true;
      line_.done();
      return;
    }
    sending_ = false;
    line_.done();
    board_.wait(seen, kIdle);
  }
  if (goodbye_) line_.say_goodbye();
}

}  // namespace stdc
