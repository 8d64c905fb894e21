// What a page sends to the live view: messages, the frames that they come in, and the headers and the query
// of who wants to see it. The input is split at the first three line feeds: message, Host, Origin, query; all
// of it is read as frames too.
#include "viewer/server/view_request.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "viewer/server/view_access.hpp"
#include "viewer/server/web_socket_reader.hpp"

namespace {

/// However the bytes are cut, they give the same messages, and never more is held than is allowed.
std::string messages_of(std::string_view bytes, std::size_t piece) {
  stdc::WebSocketReader reader(stdc::kMaxRequest);
  std::string all;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size()))) {
    reader.add(bytes.substr(0, piece));
    while (const auto message = reader.next()) {
      if (message->content.size() > 125) std::abort();
      all += static_cast<char>(message->kind) + message->content + '\n';
    }
    constexpr std::size_t kMaxHead = 14, kMaxControl = 125;
    if (reader.size() > stdc::kMaxRequest + kMaxHead + kMaxControl) std::abort();
  }
  return reader.refusal() ? all + "refused" : all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  if (messages_of(rest, 1) != messages_of(rest, std::max<std::size_t>(size, 1))) std::abort();
  const auto next = [&rest] {
    const std::string_view part = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(part.size() < rest.size() ? part.size() + 1 : rest.size());
    return part;
  };
  const std::string_view message = next(), host = next(), origin = next(), query = next();
  const auto request = stdc::parse_view_request(message);
  if (request && request->kind == stdc::ViewRequest::Kind::want && request->value > stdc::kWantAll)
    std::abort();
  const stdc::ViewAccess loopback(""), elsewhere("5e4b");
  const stdc::ViewAccess::Asked asked{host, origin, query};
  const bool opens = !loopback.refuse_connection(asked),
             opens_elsewhere = !elsewhere.refuse_connection(asked);
  // Whoever is let in has said so in so many words.
  if (opens && origin != "http://" + std::string(host) && origin != "https://" + std::string(host))
    std::abort();
  if (opens && loopback.refuse_page(asked)) std::abort();
  if (opens_elsewhere && query.find("token=5e4b") == std::string_view::npos) std::abort();
  return 0;
}
