#include "ros2/topic_names.hpp"

#include <algorithm>
#include <cctype>

#include "core/error.hpp"
#include "core/files/text_file.hpp"

namespace stdc::ros2 {
namespace {

constexpr std::string_view kTopicPrefix = "rt/", kTypeMiddle = "::dds_::";

bool is_topic_name(const std::string& topic) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '/'; };
  return topic.size() > 1 && topic.front() == '/' && topic.back() != '/' &&
         topic.find("//") == std::string::npos && std::all_of(topic.begin(), topic.end(), allowed);
}

std::string replaced(const std::string& text, std::string_view from, std::string_view to) {
  std::string result;
  std::size_t done = 0;
  for (std::size_t at; (at = text.find(from, done)) != std::string::npos; done = at + from.size()) {
    result.append(text, done, at - done).append(to);
  }
  return result.append(text, done, std::string::npos);
}

}  // namespace

std::string dds_topic(const std::string& topic) {
  if (!is_topic_name(topic)) {
    throw Error(shown(topic), "is no name of a topic",
                "give the full name, as `ros2 topic list` prints it: /camera/color/image_raw");
  }
  return "rt" + topic;
}

std::optional<std::string> ros_topic(const std::string& dds_topic) {
  if (!dds_topic.starts_with(kTopicPrefix)) return std::nullopt;
  return dds_topic.substr(kTopicPrefix.size() - 1);
}

std::string dds_type(const std::string& type) {
  const std::size_t slash = type.rfind('/');
  return replaced(type.substr(0, slash), "/", "::") + std::string(kTypeMiddle) + type.substr(slash + 1) + "_";
}

std::string ros_type(const std::string& dds_type) {
  const std::size_t middle = dds_type.find(kTypeMiddle);
  if (middle == std::string::npos || !dds_type.ends_with('_')) return dds_type;
  std::string type = dds_type.substr(0, middle) + "/" + dds_type.substr(middle + kTypeMiddle.size());
  type.pop_back();
  return replaced(type, "::", "/");
}

}  // namespace stdc::ros2
