#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/images/image_codec.hpp"

namespace stdc {

/// How the messages of a topic are written.
enum class Serialisation {
  ros1,   ///< of ROS 1: packed, little-endian
  cdr,    ///< of ROS 2: XCDR1, either byte order
  other,  ///< JSON, Protobuf...: not read
};

/// When a message was recorded: nanoseconds since 1970.
using LogTime = std::int64_t;

struct RecordedTopic {
  std::string name;  ///< "/camera/color/image_raw"
  std::string type;  ///< "sensor_msgs/Image": as ROS 1 writes it, also for ROS 2's "sensor_msgs/msg/Image"
  Serialisation serialisation = Serialisation::other;
  std::string definition;              ///< text of the message's definition, if the recording has it
  std::optional<std::uint64_t> count;  ///< messages, if known without reading all
};

struct RecordedMessage {
  int topic = 0;  ///< index into topics()
  LogTime log_time = 0;
  Bytes data;  ///< valid until the next call of next() or start()
};

/// A recording of messages on topics, as robots make them: a file or folder of any format. Reads with bounded
/// memory, a chunk at a time. What is damaged is left out, and faults() says so.
class Recording {
 public:
  static constexpr LogTime kBegin = std::numeric_limits<LogTime>::min();
  static constexpr LogTime kEnd = std::numeric_limits<LogTime>::max();

  virtual ~Recording() = default;
  Recording() = default;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// The file or folder, for messages.
  virtual std::string where() const = 0;
  /// "mcap", "bag" or "db3".
  virtual std::string format() const = 0;
  /// In the order of their names; settled when the recording is opened.
  virtual const std::vector<RecordedTopic>& topics() const = 0;
  virtual std::optional<LogTime> first_time() const = 0;
  virtual std::optional<LogTime> last_time() const = 0;

  /// Begins to give the messages of some topics (indices) that were recorded from `from` to `until`.
  virtual void start(std::span<const int> topics, LogTime from = kBegin, LogTime until = kEnd) = 0;
  /// The next message in order of log time; nothing at the end.
  virtual std::optional<RecordedMessage> next() = 0;

  /// What was found to be damaged so far, and what was made of it; a line each that names the file.
  virtual std::vector<std::string> faults() const = 0;

  /// Index of a topic; nothing if there is none of that name.
  std::optional<int> find_topic(std::string_view name) const;
};

/// "sensor_msgs/Image" of "sensor_msgs/msg/Image".
std::string plain_type_name(std::string_view type);

}  // namespace stdc
