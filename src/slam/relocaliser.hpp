#pragma once

#include <vector>

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "estimation/pose_optimisation.hpp"
#include "features/detection/pyramid.hpp"
#include "loop_closing/loop_closer.hpp"
#include "tracking/local_map.hpp"
#include "tracking/tracker.hpp"

namespace stdc {

/// Finds a frame of which nothing is known in the atlas: near the latest keyframes, or at a place of any map
/// that looks like it.
class Relocaliser {
 public:
  Relocaliser(const Camera& camera, const TrackingSettings& settings, const NoiseSettings& noise,
              const PoseOptimisationSettings& optimisation)
      : camera_(camera), settings_(settings), noise_(noise), optimisation_(optimisation) {}

  /// True if the landmarks around where it seems to be agree: then the frame has its pose, the tracker goes
  /// on from there, and `local_map` is what is around it. `pyramid`: of the frame's image.
  bool find(const Atlas& atlas, const LoopCloser& places, const Pyramid& pyramid, TrackedFrame& frame,
            Tracker& tracker, LocalMap& local_map) const;

 private:
  struct Guess {
    KeyframeId near;
    Pose cam_from_world;
    std::vector<LandmarkId> landmarks;  ///< per keypoint of the frame
  };
  std::vector<KeyframeId> latest_keyframes(const Atlas& atlas) const;
  bool confirm(const Atlas& atlas, const Pyramid& pyramid, const Guess& guess, TrackedFrame& frame,
               Tracker& tracker, LocalMap& local_map) const;

  Camera camera_;
  TrackingSettings settings_;
  NoiseSettings noise_;
  PoseOptimisationSettings optimisation_;
};

}  // namespace stdc
