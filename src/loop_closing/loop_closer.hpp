#pragma once

#include <optional>
#include <vector>

#include "estimation/pose_optimisation.hpp"
#include "loop_closing/loop_correction.hpp"
#include "place_recognition/loop_detector.hpp"
#include "place_recognition/place_index.hpp"

namespace stdc {

/// Recognises places: keeps the place index of a map's keyframes up to date, looks in it for the place of a
/// new keyframe (a loop, or another map) or of a frame that is lost, and closes loops. Belongs to whoever has
/// the map.
class LoopCloser {
 public:
  LoopCloser(const LoopTools& tools, const PoseOptimisationSettings& optimisation)
      : tools_(tools), optimisation_(optimisation), detector_(tools_.settings) {}

  /// Enters all keyframes of a map that was read from a file.
  void enter_all(const Atlas& atlas);
  /// Enters a keyframe that has been mapped, takes out what was culled, and looks for a place seen before.
  /// To be called for each keyframe in order.
  std::optional<VerifiedLoop> find(const Atlas& atlas, KeyframeId current);
  LoopCorrection close(Atlas& atlas, const VerifiedLoop& loop);

  /// A place where a lost frame may be, the likeliest first.
  struct FramePlace {
    KeyframeId keyframe;
    PlacePose pose;
  };
  /// The places of any map that fit a frame of which nothing is known.
  std::vector<FramePlace> locate(const Atlas& atlas, const ImageOfPlace& image) const;

 private:
  std::optional<VerifiedLoop> look(const Atlas& atlas, KeyframeId current);

  LoopTools tools_;
  PoseOptimisationSettings optimisation_;
  PlaceIndex index_;
  LoopDetector detector_;
  std::vector<KeyframeId> entered_;
  KeyframeId last_loop_;
};

}  // namespace stdc
