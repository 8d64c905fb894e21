#pragma once

#include <filesystem>

#include "run/output_folder.hpp"
#include "slam/tracking_result.hpp"

namespace stdc::app {

/// The masks of --save-masks: one PNG per frame, 255 = dynamic, named by the frame's time as `run --masks`
/// expects them; all written at the end like other results.
class SavedMasks {
 public:
  explicit SavedMasks(const std::filesystem::path& folder) : folder_(folder) {}

  /// `result` must have its mask; a frame without one (skipped) is passed over.
  void add_frame(const TrackingResult& result);
  void commit() { folder_.commit(); }

 private:
  OutputFolder folder_;
};

}  // namespace stdc::app
