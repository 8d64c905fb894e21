#pragma once

#include <vector>

#include "atlas/atlas.hpp"
#include "place_recognition/place_index.hpp"
#include "place_recognition/place_recognition_settings.hpp"

namespace stdc {

/// Tells which places that a keyframe looks like are worth a closer look: scores are added up over keyframes
/// that see each other, and a place must be found by several keyframes in succession (covisibility and
/// temporal consistency: Mur-Artal, Montiel and Tardos, 'ORB-SLAM', T-RO 2015, sec. VII-A; Galvez-Lopez and
/// Tardos, 'Bags of Binary Words', T-RO 2012, sec. V).
class LoopDetector {
 public:
  explicit LoopDetector(const PlaceRecognitionSettings& settings = {}) : settings_(settings) {}

  /// To be called for each keyframe in the order of their making; `current` need not be in the index.
  /// Keyframes that share landmarks with it, and their best neighbours, are no loops.
  /// @returns one keyframe for each consistent place, the likeliest first
  std::vector<KeyframeId> detect(const Atlas& atlas, const PlaceIndex& index, KeyframeId current);
  /// Forgets what the last keyframes found: after a loop was closed.
  void reset() { last_.clear(); }

 private:
  /// A place: a keyframe and those that share landmarks with it.
  struct Group {
    KeyframeId best;
    std::vector<KeyframeId> members;  ///< by id, `best` included
    float score = 0;                  ///< of all of them
    int length = 1;                   ///< keyframes in succession that have found it
  };

  std::vector<Group> find_groups(const Atlas& atlas, const PlaceIndex& index, KeyframeId current) const;

  PlaceRecognitionSettings settings_;
  std::vector<Group> last_;
};

}  // namespace stdc
