#include "viewer/server/web_server.hpp"

#include <civetweb.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <future>
#include <utility>

#include "viewer/server/listening.hpp"
#include "viewer/server/page_line.hpp"
#include "viewer/server/sigpipe_guard.hpp"
#include "viewer/server/thread_stacks.hpp"
#include "viewer/server/web_client.hpp"
#include "viewer/server/web_page.hpp"

namespace stdc {
namespace {

std::string listening_port(const WebAddress& address) {
  const bool is_v6 = address.host.find(':') != std::string::npos;
  return is_v6 ? fmt::format("[{}]:{}", address.host, address.port)
               : fmt::format("{}:{}", address.host, address.port);
}

ViewAccess::Asked asked_by(const mg_connection* connection) {
  const auto header = [connection](const char* name) -> std::optional<std::string_view> {
    const char* value = mg_get_header(connection, name);
    return value != nullptr ? std::optional<std::string_view>(value) : std::nullopt;
  };
  const char* query = mg_get_request_info(connection)->query_string;
  return {header("Host"), header("Origin"), query != nullptr ? query : ""};
}

/// @param host  as the page may call this server; empty: there is no page
void answer(mg_connection* connection, int code, const char* words, const WebFile& file,
            std::string_view host, bool with_content) {
  // The page may talk to where it came from, and to nobody else.
  const std::string policy =
      host.empty()
          ? "default-src 'none'"
          : fmt::format(
                "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
                "connect-src 'self' ws://{} wss://{}; base-uri 'none'; form-action 'none'; "
                "frame-ancestors 'none'",
                host, host);
  const std::string head = fmt::format(
      "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n"
      "Content-Security-Policy: {}\r\nCross-Origin-Resource-Policy: same-origin\r\n"
      "Referrer-Policy: no-referrer\r\nX-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n",
      code, words, file.type, file.content.size(), policy);
  mg_write(connection, head.data(), head.size());
  if (with_content) mg_write(connection, file.content.data(), file.content.size());
}

}  // namespace

struct WebServer::Context {
  mg_context* context = nullptr;
  WebAddress address;  ///< at which it listens
  explicit Context(WebAddress at) : address(std::move(at)) { mg_init_library(0); }
  ~Context() {
    if (context != nullptr) stop();
    mg_exit_library();
  }
  /// civetweb looks every two seconds whether it is to stop, or when somebody calls: so we call.
  void stop() {
    const auto stopped = std::async(std::launch::async, [this] { mg_stop(context); });
    while (stopped.wait_for(std::chrono::milliseconds(10)) != std::future_status::ready) {
      call_and_hang_up(address);
    }
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

/// What civetweb calls, from threads of its own. `data` is the server.
struct WebCallbacks {
  static int keep_quiet(const mg_connection* /*connection*/, const char* /*message*/) { return 1; }

  static int on_request(mg_connection* connection, void* data) {
    const auto& server = *static_cast<WebServer*>(data);
    const mg_request_info& info = *mg_get_request_info(connection);
    const std::string_view method = info.request_method, path = info.local_uri;
    const bool with_content = method != "HEAD";
    const auto refuse_with = [&](int code, const char* words, std::string_view why) {
      const std::string line = fmt::format("{}\n", why);
      answer(connection, code, words, {"text/plain; charset=utf-8", line}, "", with_content);
      return code;
    };
    if (method != "GET" && method != "HEAD") return refuse_with(405, "Method Not Allowed", "only GET");
    const auto file = web_file(path);
    if (!file) return refuse_with(404, "Not Found", "there is nothing here");
    // Its other files hold no data of the run, and are asked for without the link's token.
    const bool is_page = file->type.starts_with("text/html");
    ViewAccess::Asked asked = asked_by(connection);
    const std::string query = fmt::format("token={}", server.access_.token());
    if (!is_page) asked.query = query;
    if (const auto why = server.access_.refuse_page(asked)) return refuse_with(403, "Forbidden", *why);
    answer(connection, 200, "OK", *file, *asked.host, with_content);
    return 200;
  }

  static int on_connect(const mg_connection* connection, void* data) {
    auto& server = *static_cast<WebServer*>(data);
    if (server.access_.refuse_connection(asked_by(connection))) return 1;
    return server.clients_ < WebServer::kMaxClients ? 0 : 1;
  }

  /// Serves a page until its line ends. CivetWeb would read from it next, and finds it ended.
  static void on_ready(mg_connection* connection, void* data) {
    auto& server = *static_cast<WebServer*>(data);
    PageLine page(connection);
    auto opened = std::make_unique<WebClient>(
        server.board_, WebClient::Line{[&page](const std::string& message) { return page.send(message); },
                                       [&page] { page.say_goodbye(CloseCode::going_away); },
                                       [&server] { server.changed(); }, [&page] { page.hang_up(); }});
    WebClient& client = *opened;
    if (!server.open(std::move(opened))) return page.hang_up();
    page.listen([&](const ViewRequest& request) { server.receive(client, request); },
                [&client] { return client.dead(); });
    page.hang_up();  // what is being sent need not be waited for
    server.close(&client);
  }

  /// What came before the line was served, which no browser sends.
  static int on_data(mg_connection* /*connection*/, int /*flags*/, char* /*bytes*/, std::size_t /*size*/,
                     void* /*data*/) {
    return 0;  // end the connection
  }
};

WebServer::WebServer(const WebAddress& address, ViewAccess access, ViewBoard& board, Handlers handlers)
    : access_(std::move(access)),
      board_(board),
      handlers_(std::move(handlers)),
      context_(std::make_unique<Context>(address)) {
  const std::string port = listening_port(address), head = std::to_string(kMaxHead);
  // A connected page occupies a thread; some more are for requests.
  const std::string threads = std::to_string(kMaxClients + 8);
  const std::array<const char*, 17> options = {"listening_ports",
                                               port.c_str(),
                                               "num_threads",
                                               threads.c_str(),
                                               "request_timeout_ms",
                                               "5000",
                                               "websocket_timeout_ms",
                                               "5000",
                                               "enable_keep_alive",
                                               "no",
                                               "max_request_size",
                                               head.c_str(),
                                               "tcp_nodelay",
                                               "1",
                                               "enable_directory_listing",
                                               "no",
                                               nullptr};
  mg_callbacks callbacks{};
  callbacks.log_message = &WebCallbacks::keep_quiet;
  callbacks.log_access = &WebCallbacks::keep_quiet;
  {
    const SigpipeGuard guard;
    have_large_thread_stacks();
    context_->context = mg_start(&callbacks, this, const_cast<const char**>(options.data()));
  }
  if (context_->context == nullptr) refuse_address(address);
  mg_server_port listening{};
  if (mg_get_server_ports(context_->context, 1, &listening) == 1) port_ = listening.port;
  context_->address.port = port_;
  mg_set_websocket_handler(context_->context, "/live", &WebCallbacks::on_connect, &WebCallbacks::on_ready,
                           &WebCallbacks::on_data, nullptr, this);
  mg_set_request_handler(context_->context, "/", &WebCallbacks::on_request, this);
}

WebServer::~WebServer() {
  constexpr auto kPatience = std::chrono::milliseconds(500);
  {
    std::unique_lock lock(mutex_);
    ends_ = true;
    for (const auto& client : open_) client->end();
    // Pages answer a goodbye by hanging up; those that do not are hung up on.
    changed_.wait_for(lock, kPatience, [this] { return open_.empty(); });
    for (const auto& client : open_) client->hang_up();
  }
  context_.reset();
}

bool WebServer::open(std::unique_ptr<WebClient> client) {
  const std::lock_guard lock(mutex_);
  if (ends_) return false;
  open_.push_back(std::move(client));
  clients_ = static_cast<int>(open_.size());
  ++connections_;
  return true;
}

void WebServer::receive(WebClient& client, const ViewRequest& request) {
  if (request.kind == ViewRequest::Kind::want) {
    client.feed().want(request.value);
    update_wanted();
    board_.wake();
  } else if (request.kind == ViewRequest::Kind::keyframe) {
    client.feed().give_keyframe(handlers_.keyframe(request.value));
    board_.wake();
  } else {
    handlers_.request(request);
  }
}

void WebServer::close(WebClient* client) {
  std::unique_ptr<WebClient> closed;  // waits for its thread, without the lock
  {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(open_.begin(), open_.end(),
                                    [client](const auto& other) { return other.get() == client; });
    if (found == open_.end()) return;
    closed = std::move(*found);
    open_.erase(found);
    clients_ = static_cast<int>(open_.size());
  }
  update_wanted();
}

void WebServer::update_wanted() {
  {
    const std::lock_guard lock(mutex_);
    std::uint32_t wanted = 0;
    for (const auto& client : open_) wanted |= client->feed().wanted();
    wanted_ = wanted;
  }
  changed_.notify_all();
}

void WebServer::changed() {
  { const std::lock_guard lock(mutex_); }  // who is about to wait has either seen the change or waits by now
  changed_.notify_all();
}

bool WebServer::wait_until_wanted(std::chrono::milliseconds max) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, max, [this] { return wanted_ != 0; });
}

bool WebServer::wait_until_up_to_date(std::chrono::milliseconds max) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, max, [this] {
    return std::all_of(open_.begin(), open_.end(),
                       [](const auto& client) { return client->dead() || client->up_to_date(); });
  });
}

}  // namespace stdc
