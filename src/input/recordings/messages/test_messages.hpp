#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "input/recordings/recording.hpp"

namespace stdc::test {

/// Writes messages as ROS 1 does, or as CDR of either byte order: written after the descriptions of the
/// formats, not after the reader.
class MessageWriter {
 public:
  enum class Style { ros1, cdr_little, cdr_big };

  explicit MessageWriter(Style style) : style_(style) {
    if (!is_ros1()) bytes_ = {0, static_cast<std::uint8_t>(style == Style::cdr_little ? 1 : 0), 0, 0};
  }

  template <typename T>
  MessageWriter& number(T value) {
    if (!is_ros1()) {
      while ((bytes_.size() - 4) % sizeof(T) != 0) bytes_.push_back(0);
    }
    std::uint8_t raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_.push_back(raw[style_ == Style::cdr_big ? sizeof(T) - 1 - i : i]);
    }
    return *this;
  }
  MessageWriter& text(const std::string& value) {
    number(static_cast<std::uint32_t>(value.size() + (is_ros1() ? 0 : 1)));
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    if (!is_ros1()) bytes_.push_back(0);
    return *this;
  }
  MessageWriter& blob(const std::vector<std::uint8_t>& value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    return *this;
  }
  MessageWriter& doubles(const std::vector<double>& values) {
    for (const double value : values) number(value);
    return *this;
  }
  /// std_msgs/Header
  MessageWriter& header(std::int64_t stamp, const std::string& frame) {
    if (is_ros1()) number(std::uint32_t{7});
    number(static_cast<std::uint32_t>(stamp / 1'000'000'000));
    number(static_cast<std::uint32_t>(stamp % 1'000'000'000));
    return text(frame);
  }
  MessageWriter& pose(const Pose& pose) {
    const auto& t = pose.translation;
    const auto& q = pose.rotation;
    return doubles({t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()});
  }

  bool is_ros1() const { return style_ == Style::ros1; }
  Serialisation serialisation() const { return is_ros1() ? Serialisation::ros1 : Serialisation::cdr; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  Style style_;
  std::vector<std::uint8_t> bytes_;
};

/// sensor_msgs/Image without padding.
inline MessageWriter image_message(MessageWriter::Style style, std::int64_t stamp, const std::string& frame,
                                   int width, int height, const std::string& encoding,
                                   const std::vector<std::uint8_t>& data, bool big_endian = false) {
  MessageWriter writer(style);
  writer.header(stamp, frame)
      .number(static_cast<std::uint32_t>(height))
      .number(static_cast<std::uint32_t>(width));
  writer.text(encoding).number(static_cast<std::uint8_t>(big_endian));
  writer.number(static_cast<std::uint32_t>(data.size() / static_cast<std::size_t>(height))).blob(data);
  return writer;
}

/// sensor_msgs/CameraInfo.
inline MessageWriter camera_info_message(MessageWriter::Style style, const std::string& frame,
                                         const Camera& camera, const std::string& model,
                                         const std::vector<double>& d) {
  MessageWriter writer(style);
  writer.header(1, frame).number(static_cast<std::uint32_t>(camera.height));
  writer.number(static_cast<std::uint32_t>(camera.width)).text(model);
  writer.number(static_cast<std::uint32_t>(d.size())).doubles(d);
  writer.doubles({camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1})
      .doubles({1, 0, 0, 0, 1, 0, 0, 0, 1});
  writer.doubles({camera.fx * 0.9, 0, camera.cx + 1, 0, 0, camera.fy * 0.9, camera.cy + 1, 0, 0, 0, 1, 0});
  for (int i = 0; i < 6; ++i) writer.number(std::uint32_t{0});
  writer.number(std::uint8_t{0});
  return writer;
}

/// tf2_msgs/TFMessage of one transform.
inline MessageWriter transform_message(MessageWriter::Style style, const std::string& parent,
                                       const std::string& child, const Pose& parent_from_child) {
  MessageWriter writer(style);
  writer.number(std::uint32_t{1}).header(1, parent).text(child).pose(parent_from_child);
  return writer;
}

/// A recording in memory.
class TestRecording : public Recording {
 public:
  explicit TestRecording(std::string where = "test.bag") : where_(std::move(where)) {}

  void copy(const TestRecording& other) {
    where_ = other.where_, topics_ = other.topics_, messages_ = other.messages_;
  }
  /// Adds a message; the topic is made with its first one.
  void add(const std::string& topic, const std::string& type, LogTime time, const MessageWriter& message) {
    if (!find_topic(topic)) topics_.push_back({topic, type, message.serialisation(), "", std::uint64_t{0}});
    const int index = *find_topic(topic);
    ++*topics_[static_cast<std::size_t>(index)].count;
    messages_.push_back({index, time, message.bytes()});
    std::stable_sort(messages_.begin(), messages_.end(),
                     [](const auto& a, const auto& b) { return a.time < b.time; });
  }

  std::string where() const override { return where_; }
  std::string format() const override { return "bag"; }
  const std::vector<RecordedTopic>& topics() const override { return topics_; }
  std::optional<LogTime> first_time() const override { return messages_.front().time; }
  std::optional<LogTime> last_time() const override { return messages_.back().time; }
  void start(std::span<const int> topics, LogTime from, LogTime until) override {
    chosen_.assign(topics.begin(), topics.end());
    from_ = from;
    until_ = until;
    next_ = 0;
  }
  std::optional<RecordedMessage> next() override {
    while (next_ < messages_.size()) {
      const Message& message = messages_[next_++];
      if (message.time < from_ || message.time > until_ ||
          std::count(chosen_.begin(), chosen_.end(), message.topic) == 0)
        continue;
      return RecordedMessage{message.topic, message.time, message.data};
    }
    return std::nullopt;
  }
  std::vector<std::string> faults() const override { return {}; }

 private:
  struct Message {
    int topic;
    LogTime time;
    std::vector<std::uint8_t> data;
  };
  std::string where_;
  std::vector<RecordedTopic> topics_;
  std::vector<Message> messages_;
  std::vector<int> chosen_;
  LogTime from_ = kBegin, until_ = kEnd;
  std::size_t next_ = 0;
};

}  // namespace stdc::test
