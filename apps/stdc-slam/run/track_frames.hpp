#pragma once

#include <string>

#include "core/image_codec.hpp"
#include "report/debug_images.hpp"
#include "report/run_record.hpp"
#include "run/interrupt_watch.hpp"
#include "run/mask_record.hpp"
#include "run/mask_scoring.hpp"
#include "run/saved_masks.hpp"
#include "run/sequence_input.hpp"
#include "slam/slam.hpp"

namespace stdc::app {

struct TrackOptions {
  ColourMode colour = ColourMode::grey;
  bool realtime = false;  ///< give frames out at the pace of their timestamps, not as fast as they are taken
  bool quiet = false;
  std::string label = "tracking";  ///< of the progress line
};

/// What is kept of each frame beside the record; null: not.
struct FrameOutputs {
  DebugImages* pictures = nullptr;
  SavedMasks* masks = nullptr;
  MaskScoring* mask_scoring = nullptr;
  MaskRecord* mask_record = nullptr;
};

/// Tracks all frames of a sequence. Frames that cannot be read, or segmented, are reported on stderr and
/// survived. Throws Error if there is none or the first one cannot be read, or if the program is interrupted.
void track_frames(const SequenceInput& input, const TrackOptions& options, const InterruptWatch& interrupts,
                  Slam& slam, RunRecord& record, const FrameOutputs& outputs = {});

}  // namespace stdc::app
