#pragma once

#include <optional>
#include <vector>

#include "report/pictures/debug_images.hpp"
#include "report/pictures/sample_frames.hpp"
#include "run/dense/dense_output.hpp"
#include "run/inpaint/inpainted_folder.hpp"
#include "run/masks/mask_record.hpp"
#include "run/masks/mask_scoring.hpp"
#include "run/masks/saved_masks.hpp"
#include "run/output_folder.hpp"
#include "run/run_options.hpp"

namespace stdc::app {

/// The places of all that a run writes, but the map, and what it gathers for them on the way. Nothing appears
/// before commit().
class RunOutputs {
 public:
  /// Throws Error if a place cannot be written to, or if one lies in the way of another.
  RunOutputs(const RunOptions& options, const Settings& settings, const SequenceInput& input);

  /// Those that must see each frame.
  std::vector<FrameObserver*> observers();
  void commit();

  std::optional<InpaintedFolder> inpainted;
  OutputFolder folder;  ///< of trajectory.txt and its like
  std::optional<DenseOutput> dense;
  std::optional<DebugImages> pictures;
  std::optional<SavedMasks> masks;
  std::optional<MaskScoring> mask_scoring;
  MaskRecord mask_record;               ///< filled only for inpainting
  std::optional<SampleFrames> samples;  ///< for the report; to be made once there is a Slam
};

}  // namespace stdc::app
