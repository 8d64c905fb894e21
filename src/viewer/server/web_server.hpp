#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "viewer/server/view_access.hpp"
#include "viewer/server/view_request.hpp"
#include "viewer/server/web_address.hpp"
#include "viewer/view_board.hpp"

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
  /// Waits until some page wants something; false: none did in that time.
  bool wait_until_wanted(std::chrono::milliseconds max) const;
  /// Waits until all pages have all that there is.
  bool wait_until_up_to_date(std::chrono::milliseconds max) const;

 private:
  friend struct WebCallbacks;
  struct Context;  ///< of civetweb

  /// False: the server is about to end.
  bool open(std::unique_ptr<WebClient> client);
  void receive(WebClient& client, const ViewRequest& request);
  void close(WebClient* client);
  void update_wanted();
  void changed();

  ViewAccess access_;
  ViewBoard& board_;
  Handlers handlers_;
  std::atomic<int> clients_ = 0, connections_ = 0;
  std::atomic<std::uint32_t> wanted_ = 0;
  int port_ = 0;
  mutable std::mutex mutex_;
  mutable std::condition_variable
      changed_;  ///< a page came, went, asked for something, or has all that there is
  std::vector<std::unique_ptr<WebClient>> open_;
  bool ends_ = false;
  std::unique_ptr<Context> context_;  ///< last: its threads use what is above
};

}  // namespace stdc
