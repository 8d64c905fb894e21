#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/image_codec.hpp"

namespace stdc::ros2 {

/// How messages of a topic are to be delivered: the part of ROS 2's quality of service that is used here.
struct Delivery {
  bool reliable = true;          ///< lost messages are sent again; false: best effort
  bool transient_local = false;  ///< who comes later gets the last messages too (/tf_static)
  /// How many messages wait at most; the oldest goes. 0: all are kept, and the publisher waits.
  int depth = 10;
  bool large = false;  ///< messages of more than some kilobytes, sent by a thread of their own
};

/// ROS 2's profile for sensor data.
constexpr Delivery kSensorData{.reliable = false, .depth = 5};

/// A topic that somebody on the network publishes.
struct PublishedTopic {
  std::string name;  ///< "/camera/color/image_raw"
  std::string type;  ///< "sensor_msgs/msg/Image"
  int publishers = 0;
};

/// Which part of the network a node joins.
struct NodeOptions {
  int domain = 0;               ///< ROS_DOMAIN_ID, 0 to 232
  bool localhost_only = false;  ///< ROS_LOCALHOST_ONLY
};
/// By the environment variables ROS_DOMAIN_ID and ROS_LOCALHOST_ONLY. Throws Error for values that ROS 2 does
/// not know.
NodeOptions options_from_environment();

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
  /// Who receives them now; 0: making a message can be spared.
  virtual int subscribers() const = 0;
};

/// A participant of a ROS 2 system, by DDS alone: names and types are those that ROS 2 gives its topics on the
/// wire (rt/NAME, PACKAGE::msg::dds_::MESSAGE_; source: ROS 2 design, 'Topic and Service name mapping to
/// DDS'). The node is not listed by `ros2 node list`, which needs a topic of ROS 2's own.
class Node {
 public:
  /// Throws Error if the network cannot be joined.
  explicit Node(const NodeOptions& options);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// @param topic  "/camera/color/image_raw"
  /// @param type   "sensor_msgs/msg/Image"
  /// @param on_message  called by a thread of the middleware when messages wait, until the subscription is
  ///                    gone; may be empty
  /// The subscription must not outlive the node. Throws Error for a name that is none.
  std::unique_ptr<Subscription> subscribe(const std::string& topic, const std::string& type,
                                          const Delivery& delivery, std::function<void()> on_message = {});
  /// The same for sending.
  std::unique_ptr<Publication> advertise(const std::string& topic, const std::string& type,
                                         const Delivery& delivery);
  /// What others publish, in the order of the names; only topics of ROS 2.
  std::vector<PublishedTopic> published() const;
  const NodeOptions& options() const { return options_; }

 private:
  class Participant;
  NodeOptions options_;
  std::unique_ptr<Participant> participant_;
};

}  // namespace stdc::ros2
