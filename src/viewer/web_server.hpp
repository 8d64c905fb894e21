#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "viewer/view_access.hpp"
#include "viewer/view_board.hpp"
#include "viewer/view_request.hpp"
#include "viewer/web_address.hpp"

namespace stdc {

class WebClient;

/// Gives the page by HTTP and what is on a board by WebSocket, to some pages at a time. Each has a thread
/// that sends to it, so a slow line holds up nobody else.
class WebServer {
 public:
  static constexpr int kMaxClients = 16;
  static constexpr std::size_t kMaxHead = 8192;  ///< [bytes] of the head of a request

  struct Handlers {
    /// A page asks for something that concerns the run; on one of the server's threads.
    std::function<void(const ViewRequest& request)> request;
    std::function<ViewMessage(std::uint32_t frame)> keyframe;
  };

  /// Starts to listen. Throws Error if the address cannot be had.
  WebServer(const WebAddress& address, ViewAccess access, ViewBoard& board, Handlers handlers);
  /// Ends all connections; takes some seconds if a line is stuck.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  int port() const { return port_; }
  int clients() const { return clients_; }
  /// Pages that have connected so far.
  int connections() const { return connections_; }
  /// What some page wants: a sum of ViewWant.
  std::uint32_t wanted() const { return wanted_; }
  /// Whether all pages have all that there is.
  bool all_up_to_date() const;

 private:
  friend struct WebCallbacks;
  struct Context;  ///< of civetweb

  void open(std::unique_ptr<WebClient> client);
  void receive(WebClient& client, const ViewRequest& request);
  void close(WebClient* client);
  void update_wanted();

  ViewAccess access_;
  ViewBoard& board_;
  Handlers handlers_;
  std::atomic<int> clients_ = 0, connections_ = 0;
  std::atomic<std::uint32_t> wanted_ = 0;
  int port_ = 0;
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<WebClient>> open_;
  std::unique_ptr<Context> context_;  ///< last: its threads use what is above
};

}  // namespace stdc
