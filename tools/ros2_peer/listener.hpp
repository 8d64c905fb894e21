#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "peer.hpp"

namespace stdc::ros2_peer {

/// Receives odometry and transforms in a thread of its own, and writes them down as text.
class Listener {
 public:
  explicit Listener(const Participant& participant);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// How many odometry messages came so far.
  int odometry_count() const;
  /// Stamp of the last one [ns].
  std::int64_t last_stamp() const;
  /// Whether somebody publishes odometry and knows this listener: odometry that is sent before is lost. That
  /// diagnostics come, once a second, shows it, for they were subscribed to later.
  bool connected() const;
  /// "stamp x y z qx qy qz qw c00 c11 ... c55 frame child" a line.
  std::string odometry() const;
  /// "stamp parent child x y z qx qy qz qw" a line, of /tf.
  std::string transforms() const;
  /// Names and levels of the last diagnostics, and their values: "level name: message; key=value...".
  std::string diagnostics() const;
  /// Counts of messages on path, landmarks and images.
  std::string counts() const;
  /// When the odometry of each stamp came.
  std::map<std::int64_t, Clock::time_point> arrivals() const;

 private:
  void work();
  void take_odometry();
  void take_transforms();
  void take_diagnostics();
  void take_others();

  dds_entity_t odometry_, tf_, diagnostics_, path_, landmarks_, mask_, debug_;
  mutable std::mutex mutex_;
  std::string odometry_lines_, tf_lines_, diagnostics_lines_;
  std::map<std::int64_t, Clock::time_point> arrivals_;
  std::int64_t last_stamp_ = 0;
  int paths_ = 0, poses_in_path_ = 0, clouds_ = 0, points_ = 0, masks_ = 0, debug_images_ = 0;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace stdc::ros2_peer
