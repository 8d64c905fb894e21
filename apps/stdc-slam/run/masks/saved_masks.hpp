#pragma once

#include <filesystem>

#include "run/frame_observer.hpp"
#include "run/output_folder.hpp"

namespace stdc::app {

/// The masks of --save-masks: one PNG per frame, 255 = dynamic, named by the frame's time as `run --masks`
/// expects them; all written at the end like other results.
class SavedMasks : public FrameObserver {
 public:
  explicit SavedMasks(const std::filesystem::path& folder) : folder_(folder) {}

  /// The result must have its mask; a frame without one (skipped) is passed over.
  void on_frame(const ObservedFrame& frame) override;
  void commit() { folder_.commit(); }

 private:
  OutputFolder folder_;
};

}  // namespace stdc::app
