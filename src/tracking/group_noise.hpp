#pragma once

#include <array>
#include <deque>
#include <set>

namespace stdc {

/// Where a group of matches lies: which of the overlapping divisions, column, row and range of depth.
using GroupPlace = std::array<int, 4>;

/// How far groups of matches at rest are off in this recording: a good sensor in a sharp image shows a motion
/// of half a pixel, a Kinect in a hand has errors of a pixel in most seconds. And where groups were off by
/// much in the last frame, since what moves goes on moving.
class GroupNoise {
 public:
  /// Of a frame [s]: the middle one of its groups' shifts [px]. A frame seen again counts once.
  void add(double timestamp, double shift);
  /// A shift of this many pixels is that of no group at rest; infinite before half a second is known, and
  /// where it would be a pixel or more: then errors are so large that those that move may have taken the pose
  /// along.
  double threshold(double timestamp) const;

  /// Whether a group at this place, or a neighbouring one, was off in the frame before this one.
  bool was_off(const GroupPlace& place) const { return before_.contains(place); }
  void note_off(const GroupPlace& place) { now_.insert(place); }

  void clear();

 private:
  struct Entry {
    double timestamp = 0, shift = 0;
  };
  std::deque<Entry> entries_;
  std::set<GroupPlace> before_, now_;
};

}  // namespace stdc
