#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/images/image_codec.hpp"

namespace stdc::ros2 {

/// How messages of a topic are to be delivered: the part of ROS 2's quality of service that is used here.
struct Delivery {
  bool reliable = true;          ///< lost messages are sent again; false: best effort
  bool transient_local = false;  ///< who comes later gets the last messages too, if it asks (/tf_static)
  /// How many messages wait at most; the oldest goes. 0: all are kept, and the publisher waits.
  int depth = 10;
  bool large = false;  ///< messages of more than some kilobytes, sent by a thread of their own
};

/// ROS 2's profile for sensor data.
constexpr Delivery kSensorData{.reliable = false, .depth = 5};

/// Receives the messages of one topic.
class Subscription {
 public:
  virtual ~Subscription() = default;
  Subscription() = default;
  Subscription(const Subscription&) = delete;
  Subscription& operator=(const Subscription&) = delete;

  /// The oldest message that waits, as CDR with its encapsulation; nothing if none does. From any thread.
  virtual std::optional<std::vector<std::uint8_t>> take() = 0;
  /// Publishers that it is connected with now.
  virtual int publishers() const = 0;
  /// Messages that are known to be lost on the way.
  virtual int lost() const = 0;
  /// Which quality of service a publisher does not offer, in words; empty: none.
  virtual std::string incompatibility() const = 0;
};

/// Sends messages on one topic.
class Publication {
 public:
  virtual ~Publication() = default;
  Publication() = default;
  Publication(const Publication&) = delete;
  Publication& operator=(const Publication&) = delete;

  /// `message`: CDR with its encapsulation. From one thread at a time. False if it could not be sent.
  virtual bool publish(Bytes message) = 0;
  /// Waits until all who are connected have what was sent, but not for long.
  virtual void flush() = 0;
  /// Who receives them now; 0: making a message can be spared.
  virtual int subscribers() const = 0;
};

}  // namespace stdc::ros2
