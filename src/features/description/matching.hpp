#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "features/frame_features.hpp"

namespace stdc {

/// The nearest descriptor of a search, and how near the next one was.
struct BestMatch {
  int index = -1;      ///< keypoint; -1: none
  int distance = 257;  ///< bits
  int level = -1;      ///< of the best
  int second = 257;    ///< distance of the second best
  int second_level = -1;

  /// Reliable: near, and clearly nearer than a rival on the same pyramid level.
  bool accepted(int max_distance, double max_ratio) const {
    if (index < 0 || distance > max_distance) return false;
    return level != second_level || distance <= max_ratio * second;
  }
};

/// Where to look for a keypoint.
struct SearchWindow {
  float x = 0, y = 0;                ///< ideal pixel
  float radius = 0;                  ///< [px] along each axis
  int min_level = 0, max_level = 0;  ///< of the pyramid
};

/// Best match of a descriptor among the keypoints of a window that are not `taken` (per keypoint; empty: none
/// is).
BestMatch match_in_window(const FrameFeatures& frame, const Descriptor& query, const SearchWindow& window,
                          std::span<const std::uint8_t> taken);

/// A pair of keypoints of two frames.
struct KeypointPair {
  int first = 0, second = 0;
};

/// For each keypoint of `a` where `use_a` is not 0 its nearest in `b` (all of it, no window): mutual, at most
/// `max_distance` bits apart and nearer than `max_ratio` times the next.
std::vector<KeypointPair> match_all(const FrameFeatures& a, std::span<const std::uint8_t> use_a,
                                    const FrameFeatures& b, int max_distance, double max_ratio);

/// Keeps the pairs whose keypoints rotated by about the same angle: those in the three fullest of 30 bins of
/// the angle differences (Mur-Artal et al., 'ORB-SLAM', T-RO 2015).
/// @param rotations  angle of the first minus angle of the second keypoint, per pair [rad]
/// @returns per pair 1 keep, 0 drop
std::vector<std::uint8_t> consistent_rotations(std::span<const float> rotations);

}  // namespace stdc
