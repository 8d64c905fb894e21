#pragma once

#include <memory>
#include <vector>

#include "replay.hpp"
#include "tracking/frame_matching.hpp"

namespace stdc {

/// The frames that are tracked, loaded once.
const Footage& footage();

/// A frame about to be tracked, and what each step of tracking hands to the next.
struct Moment {
  RgbdImage image;
  Features raw;
  std::shared_ptr<const Pyramid> pyramid;
  Tracker tracker;
  LocalMap local_map;
  TrackedFrame fresh;                         ///< nothing is known but its features
  TrackedFrame predicted;                     ///< where it is looked for
  std::vector<FrameMatch> from_last;          ///< matches to the last frame that agree
  TrackedFrame located;                       ///< where those put it
  std::vector<FrameMatch> from_map;           ///< with those to the local map
  std::vector<PoseObservation> observations;  ///< the same for the optimiser
};

/// Frames taken evenly from the footage, each with the map as it was then; in turn.
class Moments {
 public:
  Moments() { all(); }  // before the timer starts
  const Moment& next() { return all()[next_++ % all().size()]; }

 private:
  static const std::vector<Moment>& all();
  std::size_t next_ = 0;
};

}  // namespace stdc
