// The part of Pipeline that has to do with the dense map: which frames go into it, and when.
#include <utility>

#include "slam/pipeline.hpp"

namespace stdc {

/// Keeps what the dense map needs of a tracked frame until it is known what moves in it. That is found beside
/// whatever comes next: the tracker does not wait for it.
void Pipeline::note_dense(const RgbdImage& image, const TrackedFrame& frame) {
  if (image.depth.empty()) return;
  DenseFrame dense;
  dense.frame = frame.index;
  dense.timestamp = frame.timestamp;
  dense.reference = local_map_.reference;
  dense.cam_from_reference = from_reference(frame);
  view_planner_.plan(back_end_.snapshot(), dense);
  dense.depth = image.depth;
  if (dense.starts_view) dense.colour = image.lasting(image.colour);
  if (settings_.dense.masks) dense.dynamic = segmented_;
  next_dense_ = std::move(dense);
}

/// Gives the last frame to the dense map, without all that may move in it.
void Pipeline::hand_over_dense() {
  if (!next_dense_) return;
  DenseFrame dense = *std::exchange(next_dense_, std::nullopt);
  if (settings_.dense.masks && motion_ && observed_frame_ == dense.frame) {
    dense.moving = motion_->found();
    dense.doubtful = motion_->doubtful();
  }
  dense_->add(std::move(dense));
}

DenseViews Pipeline::dense_views() const { return dense_ ? dense_->views() : loaded_views_; }

}  // namespace stdc
