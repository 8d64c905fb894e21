#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "slam/system_tests/test_sequence.hpp"

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
  /// Of each frame the distance of its pose, as it was told at the time, from the truth [m]: in the
  /// coordinates of its map, which begins at the first frame that was told to be in it. -1: no pose.
  std::vector<double> live_errors() const;
  /// The largest distance of the final trajectory's poses, each in its map.
  double worst_error_of_all();

  Slam slam;
  double time = 0;
  std::vector<TrackingResult> results;
  std::vector<int> places;  ///< of the frames that are ok

 private:
  std::vector<int> all_places_;
  static Settings small(Settings settings);
};

}  // namespace stdc::test
