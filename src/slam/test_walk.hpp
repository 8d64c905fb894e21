#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "slam/test_sequence.hpp"

namespace stdc::test {

constexpr double kStep = 1 / 15.0;  // [s]

class Walk {
 public:
  using Change = std::function<void(RgbdImage&)>;

  explicit Walk(Settings settings = {}, std::unique_ptr<Segmenter> segmenter = nullptr);

  TrackingResult see(
      int place, const Change& change = [](RgbdImage&) {});
  /// From one place to another, both included.
  void go(
      int from, int to, const Change& change = [](RgbdImage&) {});
  int count(TrackingStatus status, std::size_t from = 0) const;
  /// Largest distance from the truth of frames in a map, whose first frame was taken at `origin` [m].
  double worst_error(MapId map, int origin);

  Slam slam;
  double time = 0;
  std::vector<TrackingResult> results;
  std::vector<int> places;  ///< of the frames that have a pose

 private:
  static Settings small(Settings settings);
};

}  // namespace stdc::test
