#pragma once

#include <functional>
#include <optional>
#include <string>

#include "viewer/server/view_request.hpp"
#include "viewer/server/web_socket_reader.hpp"

struct mg_connection;

namespace stdc {

/// The WebSocket of a page: sends by CivetWeb, and reads by itself, since CivetWeb takes messages of up to 2
/// GB into memory before it hands them over. Sending and hanging up are for any thread.
class PageLine {
 public:
  /// Status codes of RFC 6455, 7.4.1.
  enum Code : int { kNormal = 1000, kGoingAway = 1001, kNotUnderstood = 1008 };

  explicit PageLine(mg_connection* connection);

  /// A message; waits for the line. False: the line is dead.
  bool send(const std::string& message) const;
  void say_goodbye(int code) const;
  /// Ends the line at once, whatever is being sent. CivetWeb closes it when it sees that.
  void hang_up() const;

  using Receive = std::function<void(const ViewRequest& request)>;
  /// Gives the requests of the page until its line ends, it sends what it may not, it is silent for half a
  /// minute, or `is_dead`; says goodbye if there is a reason to tell.
  void listen(const Receive& receive, const std::function<bool()>& is_dead) const;

 private:
  std::optional<int> read_requests(const Receive& receive, const std::function<bool()>& is_dead) const;
  std::optional<int> answer(const WebSocketReader::Message& message, const Receive& receive) const;

  mg_connection* connection_;
  int socket_;  ///< of the connection, which owns it; -1: not found
};

}  // namespace stdc
