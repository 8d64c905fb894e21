#pragma once

#include <map>

#include "input/recordings/recording.hpp"

namespace stdc::ros2 {

/// The first messages of a few topics, as a recording: so cameras are found in a running system by what finds
/// them in a recorded one. Holds a bounded number of messages of each topic.
class CollectedMessages : public Recording {
 public:
  /// @returns index of the topic
  int add_topic(const std::string& name, const std::string& type);
  /// Further messages of a topic than `max` are left out.
  void add(int topic, LogTime time, Bytes data, int max);
  int count(int topic) const;

  std::string where() const override { return "ROS 2"; }
  std::string format() const override { return "ros2"; }
  const std::vector<RecordedTopic>& topics() const override { return topics_; }
  std::optional<LogTime> first_time() const override;
  std::optional<LogTime> last_time() const override;
  void start(std::span<const int> topics, LogTime from, LogTime until) override;
  std::optional<RecordedMessage> next() override;
  std::vector<std::string> faults() const override { return {}; }

 private:
  struct Kept {
    int topic = 0;
    LogTime time = 0;
    std::vector<std::uint8_t> data;
  };
  std::vector<RecordedTopic> topics_;
  std::vector<Kept> messages_;  ///< in order of time
  std::vector<int> chosen_;
  LogTime from_ = kBegin, until_ = kEnd;
  std::size_t next_ = 0;
};

}  // namespace stdc::ros2
