#pragma once

#include <optional>
#include <string>

namespace stdc {

/// How a source is to be opened.
struct SourceOptions {
  std::string kind;            ///< one of source_kinds(); empty: found by looking
  int max_waiting = 3;         ///< frames of a live camera that may wait; more of them are dropped
  std::optional<double> rate;  ///< [Hz] takes the order of the images for the time, in place of their stamps
  /// Topics of recordings; empty: found by looking, if there is one sensible choice.
  std::string colour_topic, depth_topic, colour_info_topic, depth_info_topic, imu_topic, truth_topic;

  bool has_topic() const {
    return !(colour_topic.empty() && depth_topic.empty() && colour_info_topic.empty() &&
             depth_info_topic.empty() && imu_topic.empty() && truth_topic.empty());
  }
};

}  // namespace stdc
