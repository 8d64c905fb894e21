#include "viewer/server/view_request.hpp"

#include <charconv>

namespace stdc {
namespace {

std::optional<std::uint32_t> number(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<ViewRequest> parse_view_request(std::string_view text) {
  using Kind = ViewRequest::Kind;
  if (text.size() > kMaxRequest) return std::nullopt;
  if (text == "pause") return ViewRequest{Kind::pause};
  if (text == "resume") return ViewRequest{Kind::resume};
  if (text == "step") return ViewRequest{Kind::step};
  const std::size_t space = text.find(' ');
  if (space == std::string_view::npos) return std::nullopt;
  const std::string_view word = text.substr(0, space);
  const std::optional<std::uint32_t> value = number(text.substr(space + 1));
  if (!value) return std::nullopt;
  if (word == "want" && *value <= kWantAll) return ViewRequest{Kind::want, *value};
  if (word == "keyframe") return ViewRequest{Kind::keyframe, *value};
  return std::nullopt;
}

}  // namespace stdc
