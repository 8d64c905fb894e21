#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ros2/endpoints.hpp"
#include "ros2/node_options.hpp"

namespace stdc::ros2 {

/// A topic that somebody on the network publishes.
struct PublishedTopic {
  std::string name;  ///< "/camera/color/image_raw"
  std::string type;  ///< "sensor_msgs/msg/Image"
  int publishers = 0;
};

/// A participant of a ROS 2 system, by DDS alone: names and types are those that ROS 2 gives its topics on
/// the wire (rt/NAME, PACKAGE::msg::dds_::MESSAGE_; source: ROS 2 design, 'Topic and Service name mapping to
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
