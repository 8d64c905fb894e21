#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "slam/slam.hpp"

namespace stdc::app {

/// What a run has found out about its loops.
class LoopRecord {
 public:
  struct Entry {
    LoopReport report;
    std::optional<double> timestamp;  ///< of the frame at which it was collected [s]; nothing: after the last
  };

  void add(const TrackingResult& result);
  /// One that was collected after the last frame.
  void add(const LoopReport& loop) { loops_.push_back({loop, std::nullopt}); }

  const std::vector<Entry>& entries() const { return loops_; }

  /// Loops that were closed within a map, and maps that were joined by one.
  int loops() const { return static_cast<int>(loops_.size()) - merges(); }
  int merges() const;
  /// Quantiles of the times of looking for places, of finding loops and of correcting the map, and of what
  /// was corrected; null if no place was looked for.
  nlohmann::ordered_json to_json() const;
  /// The loops in a line for the terminal; empty if there were none.
  std::string text() const;

 private:
  std::vector<double> recognition_;  ///< [ms] per keyframe
  std::vector<Entry> loops_;
};

}  // namespace stdc::app
