#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "viewer/server/view_request.hpp"
#include "viewer/server/web_socket_reader.hpp"

struct mg_connection;

namespace stdc {

/// The WebSocket of a page: sends by CivetWeb, and reads by itself, since CivetWeb takes messages of up to 2
/// GB into memory before it hands them over. Sending and hanging up are for any thread.
class PageLine {
 public:
  explicit PageLine(mg_connection* connection);
  PageLine(const PageLine&) = delete;
  PageLine& operator=(const PageLine&) = delete;

  /// A message; waits for the line. False: the line is dead.
  bool send(const std::string& message);
  /// Once; after it nothing is sent.
  void say_goodbye(CloseCode code);
  /// Ends the line at once, whatever is being sent. CivetWeb closes it when it sees that.
  void hang_up() const;

  using Receive = std::function<void(const ViewRequest& request)>;
  /// Gives the requests of the page until its line ends, it sends what it may not, it is silent for half a
  /// minute, or `is_dead`; says goodbye if there is a reason to tell.
  void listen(const Receive& receive, const std::function<bool()>& is_dead);

 private:
  bool write(int opcode, std::string_view content);
  std::optional<CloseCode> read_requests(const Receive& receive, const std::function<bool()>& is_dead);
  std::optional<CloseCode> answer(const WebSocketReader::Message& message, const Receive& receive);

  mg_connection* connection_;
  int socket_;  ///< of the connection, which owns it; -1: not found
  std::mutex mutex_;
  bool said_goodbye_ = false;
};

}  // namespace stdc
