#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "viewer/view_feed.hpp"

namespace stdc {

/// A page that is connected, and the thread that sends to it.
class WebClient {
 public:
  struct Line {
    std::function<bool(const std::string& message)> send;  ///< waits for the line; false: it is dead
    std::function<void()> say_goodbye;
    std::function<void()> done;  ///< all that there is has been sent, or nothing can be
    std::function<void()> hang_up;
  };
  WebClient(ViewBoard& board, Line line);
  ~WebClient();
  WebClient(const WebClient&) = delete;
  WebClient& operator=(const WebClient&) = delete;

  ViewFeed& feed() { return feed_; }
  const ViewFeed& feed() const { return feed_; }
  /// Says goodbye when what it is sending is sent, and sends no more. Returns at once.
  void end();
  /// Ends the line at once, whatever is being sent.
  void hang_up() const { line_.hang_up(); }
  /// The line has taken all that there is, now.
  bool up_to_date() const { return !sending_ && feed_.up_to_date(); }
  /// Nothing can be sent any more.
  bool dead() const { return dead_; }

 private:
  void run();

  ViewBoard& board_;
  Line line_;
  ViewFeed feed_;
  std::atomic<bool> stop_ = false, goodbye_ = false, dead_ = false, sending_ = false;
  std::thread thread_;
};

}  // namespace stdc
