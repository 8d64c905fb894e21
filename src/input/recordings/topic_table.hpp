#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "input/recordings/recording.hpp"

namespace stdc {

/// Collects the topics of a recording while it is opened. A format numbers its connections or channels;
/// several of them may be of one topic, one for each that published on it.
class TopicTable {
 public:
  void add(std::uint64_t channel, RecordedTopic topic);
  bool has(std::uint64_t channel) const { return index_of_channel_.contains(channel); }
  /// Adds to the count of the channel's topic, if there is one.
  void count(std::uint64_t channel, std::uint64_t messages);
  /// Puts the topics into the order of their names; nothing is added afterwards.
  void settle();

  const std::vector<RecordedTopic>& topics() const { return topics_; }
  /// Index of the topic; -1 if the channel is not known.
  int topic_of(std::uint64_t channel) const;

 private:
  std::vector<RecordedTopic> topics_;
  std::map<std::uint64_t, int> index_of_channel_;
};

}  // namespace stdc
