#include "input/recordings/topic_table.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace stdc {

void TopicTable::add(std::uint64_t channel, RecordedTopic topic) {
  if (has(channel)) return;
  const auto same = std::find_if(topics_.begin(), topics_.end(), [&](const RecordedTopic& known) {
    return known.name == topic.name && known.type == topic.type && known.serialisation == topic.serialisation;
  });
  index_of_channel_[channel] = static_cast<int>(same - topics_.begin());
  if (same == topics_.end()) topics_.push_back(std::move(topic));
}

void TopicTable::count(std::uint64_t channel, std::uint64_t messages) {
  const int topic = topic_of(channel);
  if (topic < 0) return;
  std::optional<std::uint64_t>& count = topics_[static_cast<std::size_t>(topic)].count;
  count = count.value_or(0) + messages;
}

void TopicTable::settle() {
  std::vector<int> order(topics_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const RecordedTopic &s = topics_[static_cast<std::size_t>(a)], &t = topics_[static_cast<std::size_t>(b)];
    return std::tie(s.name, s.type) < std::tie(t.name, t.type);
  });
  std::vector<RecordedTopic> sorted;
  std::vector<int> place(topics_.size());
  for (const int old : order) {
    place[static_cast<std::size_t>(old)] = static_cast<int>(sorted.size());
    sorted.push_back(std::move(topics_[static_cast<std::size_t>(old)]));
  }
  topics_ = std::move(sorted);
  for (auto& [channel, index] : index_of_channel_) index = place[static_cast<std::size_t>(index)];
}

int TopicTable::topic_of(std::uint64_t channel) const {
  const auto found = index_of_channel_.find(channel);
  return found == index_of_channel_.end() ? -1 : found->second;
}

}  // namespace stdc
