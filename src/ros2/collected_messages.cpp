#include "ros2/collected_messages.hpp"

#include <algorithm>

namespace stdc::ros2 {

int CollectedMessages::add_topic(const std::string& name, const std::string& type) {
  topics_.push_back({name, plain_type_name(type), Serialisation::cdr, "", std::nullopt});
  return static_cast<int>(topics_.size()) - 1;
}

void CollectedMessages::add(int topic, LogTime time, Bytes data, int max) {
  if (count(topic) < max) messages_.push_back({topic, time, {data.begin(), data.end()}});
}

int CollectedMessages::count(int topic) const {
  return static_cast<int>(std::count_if(messages_.begin(), messages_.end(),
                                        [&](const Kept& message) { return message.topic == topic; }));
}

std::optional<LogTime> CollectedMessages::first_time() const {
  return messages_.empty() ? std::nullopt : std::optional(messages_.front().time);
}

std::optional<LogTime> CollectedMessages::last_time() const {
  return messages_.empty() ? std::nullopt : std::optional(messages_.back().time);
}

void CollectedMessages::start(std::span<const int> topics, LogTime from, LogTime until) {
  chosen_.assign(topics.begin(), topics.end());
  from_ = from;
  until_ = until;
  next_ = 0;
}

std::optional<RecordedMessage> CollectedMessages::next() {
  while (next_ < messages_.size()) {
    const Kept& message = messages_[next_++];
    const bool chosen = std::find(chosen_.begin(), chosen_.end(), message.topic) != chosen_.end();
    if (chosen && message.time >= from_ && message.time <= until_) {
      return RecordedMessage{message.topic, message.time, message.data};
    }
  }
  return std::nullopt;
}

}  // namespace stdc::ros2
