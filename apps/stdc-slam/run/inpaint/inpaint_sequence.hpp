#pragma once

#include <cstdint>
#include <vector>

#include "dense/inpainting/inpainting_settings.hpp"
#include "run/inpaint/inpainted_folder.hpp"
#include "run/interrupt_watch.hpp"
#include "run/masks/mask_record.hpp"
#include "run/sequence_input.hpp"
#include "slam/tracking_result.hpp"

namespace stdc::app {

struct InpaintOptions {
  bool all = false;  ///< fill from later frames too
  bool quiet = false;
  int threads = 0;  ///< 0: one for each core; the results do not depend on it
};

/// How much was filled.
struct InpaintReport {
  std::int64_t replaced = 0, unknown = 0;  ///< pixels, of all frames
  int frames = 0, without_pose = 0;        ///< frames written; of them those whose background is not known
  double seconds = 0;
};

/// Goes through the images of a sequence again, when all poses are known, and writes them without what moves.
/// A frame that cannot be read is left out.
/// @param poses  final ones; FramePose::frame counts the frames of the input
/// Throws Error if a file cannot be written, or if the program is interrupted.
InpaintReport inpaint_sequence(const SequenceInput& input, const InpaintingSettings& settings,
                               const InpaintOptions& options, const std::vector<FramePose>& poses,
                               const MaskRecord& masks, const InterruptWatch& interrupts,
                               InpaintedFolder& folder);

}  // namespace stdc::app
