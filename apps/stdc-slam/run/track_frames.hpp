#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/images/image_codec.hpp"
#include "report/run_record.hpp"
#include "run/frame_loader.hpp"
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

/// The next frame; nothing at the end, which an interruption is to a live source: it is taken, and what has
/// come already is still given.
std::optional<LoadedFrame> next_frame(const SequenceInput& input, FrameLoader& loader,
                                      const InterruptWatch& interrupts);

/// Tracks all frames of a sequence. Frames that cannot be read, or segmented, are reported on stderr and
/// survived.
/// @param observers  see each frame after the record, in this order
/// Throws Error if there is none or the first one cannot be read, or if the program is interrupted. A live
/// source knows no other end: there an interruption is one, and is taken.
void track_frames(const SequenceInput& input, const TrackOptions& options, const InterruptWatch& interrupts,
                  Slam& slam, RunRecord& record, std::span<FrameObserver* const> observers = {});

}  // namespace stdc::app
