#pragma once

#include <span>
#include <string>

#include "core/image_codec.hpp"
#include "report/run_record.hpp"
#include "run/frame_observer.hpp"
#include "run/interrupt_watch.hpp"
#include "run/sequence_input.hpp"
#include "slam/slam.hpp"

namespace stdc::app {

struct TrackOptions {
  ColourMode colour = ColourMode::grey;
  bool realtime = false;  ///< give frames out at the pace of their timestamps, not as fast as they are taken
  bool quiet = false;
  std::string label = "tracking";  ///< of the progress line
};

/// Tracks all frames of a sequence. Frames that cannot be read, or segmented, are reported on stderr and
/// survived.
/// @param observers  see each frame after the record, in this order
/// Throws Error if there is none or the first one cannot be read, or if the program is interrupted.
void track_frames(const SequenceInput& input, const TrackOptions& options, const InterruptWatch& interrupts,
                  Slam& slam, RunRecord& record, std::span<FrameObserver* const> observers = {});

}  // namespace stdc::app
