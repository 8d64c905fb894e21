#pragma once

#include <functional>
#include <memory>
#include <string>

#include "ros2/endpoints.hpp"
#include "ros2/node_options.hpp"

namespace stdc::ros2 {

/// A participant for reliable subscriptions to large messages.
///
/// It stands on the RTPS layer of Fast DDS, below DDS. Where a publisher says that it will not repeat a
/// message of which some fragments have come (a GAP, which publishers that keep only their last messages
/// send under overload), the reader of version 2.9's DDS layer keeps a dangling pointer and later fails an
/// assertion.
class ReliableParticipant {
 public:
  /// Throws Error if the network cannot be joined.
  explicit ReliableParticipant(const NodeOptions& options);
  ~ReliableParticipant();
  ReliableParticipant(const ReliableParticipant&) = delete;
  ReliableParticipant& operator=(const ReliableParticipant&) = delete;

  /// @param wire_name, wire_type  as DDS has them
  /// @param delivery  with a depth of 0 no more messages are accepted while 16 wait, so a publisher that
  /// keeps
  ///                  its messages has to wait for us; else the oldest goes
  /// @param on_message  called by a thread of the middleware; may be empty
  /// Must not outlive the participant. Throws Error if it cannot be made.
  std::unique_ptr<Subscription> subscribe(const std::string& wire_name, const std::string& wire_type,
                                          const Delivery& delivery, std::function<void()> on_message);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stdc::ros2
