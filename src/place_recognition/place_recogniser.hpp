#pragma once

#include <optional>
#include <vector>

#include "place_recognition/loop_detector.hpp"
#include "place_recognition/loop_verification.hpp"
#include "place_recognition/place_index.hpp"

namespace stdc {

/// Recognises places of an atlas: keeps the place index of its keyframes up to date, and looks in it for the
/// place of a new keyframe (a loop, or another map) or of a frame that is lost. Belongs to whoever has the
/// atlas.
class PlaceRecogniser {
 public:
  PlaceRecogniser(const PoseEstimator& estimator, const PlaceRecognitionSettings& settings)
      : estimator_(estimator), settings_(settings), detector_(settings) {}

  /// Adds all keyframes of an atlas that was read from a file.
  void add_all(const Atlas& atlas);
  /// Adds a keyframe that has been mapped, and removes what was culled.
  void add(const Atlas& atlas, KeyframeId current);
  /// The loop that a mapped keyframe closes, if any. To be called for each keyframe in order, before `add`.
  /// @param same_map  whether a loop within the keyframe's own map counts, or only one into another map
  std::optional<VerifiedLoop> find_loop(const Atlas& atlas, KeyframeId current, bool same_map);
  /// After a loop was closed: what the last keyframes found is worth nothing any more.
  void reset_detection() { detector_.reset(); }

  /// The pose of an image that may show what a keyframe shows, if it does: the caller confirms it.
  std::optional<PlacePose> locate_near(const Atlas& atlas, KeyframeId keyframe,
                                       const ImageOfPlace& image) const;
  /// The places of any map that fit an image of which nothing is known, the likeliest first.
  std::vector<PlacePose> locate(const Atlas& atlas, const ImageOfPlace& image) const;

 private:
  void remove_culled(const Atlas& atlas);

  PoseEstimator estimator_;
  PlaceRecognitionSettings settings_;
  PlaceIndex index_;
  LoopDetector detector_;
  std::vector<KeyframeId> indexed_;
};

}  // namespace stdc
