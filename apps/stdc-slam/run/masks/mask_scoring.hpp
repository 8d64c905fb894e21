#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "evaluation/mask_score.hpp"
#include "run/frame_observer.hpp"
#include "segmentation/mask_list.hpp"

namespace stdc::app {

/// Scores of all masks of a run, pixel by pixel.
struct MaskRunScore {
  int frames = 0;  ///< that have a mask and a true one
  MaskCounts counts;
};

/// The masks of --true-masks: compares the mask of what moves of each frame with the true one of its time.
class MaskScoring : public FrameObserver {
 public:
  /// `truth`: by time, as list_masks() or find_frame_masks() gives them.
  explicit MaskScoring(std::vector<MaskFile> truth) : truth_(std::move(truth)) {}

  /// The result must have its mask. Throws Error for a true mask that cannot be read or has another size.
  void on_frame(const ObservedFrame& frame) override;
  const MaskRunScore& score() const { return score_; }

 private:
  std::vector<MaskFile> truth_;
  MaskRunScore score_;
};

}  // namespace stdc::app
