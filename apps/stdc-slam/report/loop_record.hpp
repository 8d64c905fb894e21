#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "slam/slam.hpp"

namespace stdc::app {

/// What a run has found out about its loops.
class LoopRecord {
 public:
  void add(const TrackingResult& result);
  void add(const LoopReport& loop);

  /// Loops that were closed within a map, and maps that were joined by one.
  int loops() const { return static_cast<int>(correction_.size()) - merges_; }
  int merges() const { return merges_; }
  /// Quantiles of the times of looking for places, of finding loops and of correcting the map, and of what
  /// was corrected; null if no place was looked for.
  nlohmann::ordered_json to_json() const;
  /// The loops in a line for the terminal; empty if there were none.
  std::string text() const;

 private:
  int merges_ = 0;
  std::vector<double> recognition_;  ///< [ms] per keyframe
  std::vector<double> detection_, correction_, keyframes_, fused_;
};

}  // namespace stdc::app
