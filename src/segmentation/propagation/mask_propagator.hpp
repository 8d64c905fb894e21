#pragma once

#include <deque>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "segmentation/propagation/mask_tiles.hpp"
#include "segmentation/propagation/motion_field.hpp"
#include "segmentation/propagation/propagation_frame.hpp"
#include "segmentation/propagation/propagation_settings.hpp"

namespace stdc {

/// Carries the mask of an earlier frame to the newest one, so that the tracker need not wait for a
/// segmentation.
///
///     propagator.add_frame(k, grey, depth);            // every frame
///     propagator.set_mask(k - 3, mask);                // whenever one arrives, late
///     cv::Mat mask = refine(propagator.mask(), ...);   // of frame k, as far as it can be known
///
/// Points of the bodies under the mask are followed from frame to frame by sparse flow on small images (see
/// follow_patch()); each tile of the mask moves with the points around it on the same body or, where
/// none can be followed, like a static surface under the camera's motion. The moved mask gets a margin
/// that grows with its age, and loses the pixels whose depth is not the one expected there, so that it does
/// not leak onto the background. It cannot know what newly enters the view or comes out from behind
/// something.
///
/// Keeps small copies of the frames. Same calls, same bytes; no threads. One object may be used by one thread
/// at a time.
class MaskPropagator {
 public:
  /// Throws Error if a setting is out of range.
  explicit MaskPropagator(const Camera& camera, const PropagationSettings& settings = {});

  /// The next frame, to which the present mask is moved.
  /// @param frame            its number, above that of the last one
  /// @param grey             CV_8UC1 of the camera's size
  /// @param depth            CV_16UC1 or CV_32FC1, as in RgbdImage; referred to until the next call
  /// @param frame_from_last  how the camera moved, as far as it is known or predicted
  /// Throws Error for images of another size or kind.
  void add_frame(int frame, const cv::Mat& grey, const cv::Mat& depth,
                 const std::optional<Pose>& frame_from_last = {});
  /// The mask of a frame (CV_8UC1, not zero = dynamic; copied). It takes the place of the present one and is
  /// moved to the newest frame. False, and nothing changed, if that frame is not remembered or the present
  /// mask is of a later one. Throws Error for a mask of another size or kind.
  bool set_mask(int frame, const cv::Mat& mask);

  bool has_mask() const { return mask_frame_ >= 0; }
  /// The mask of the newest frame: CV_8UC1, 255 = dynamic; empty if there is none. The mask as it was given
  /// if it is that frame's own.
  cv::Mat mask() const;
  /// The parts of the mask where the newest frame has them.
  const std::vector<MaskTile>& tiles() const { return tiles_; }
  /// The newest frame, shrunk; there must be one.
  const SmallFrame& newest() const { return steps_.back().frame; }
  /// Frames from the mask's own to the newest.
  int age() const;

 private:
  struct Step {
    SmallFrame frame;
    MotionField motion;                   ///< from the frame before to this
    std::optional<Pose> frame_from_last;  ///< of the camera
  };
  void advance(const SmallFrame& from, Step& to);
  void carry(MaskTile& tile, const Step& to) const;

  Camera camera_;
  PropagationSettings settings_;
  std::deque<Step> steps_;
  cv::Mat depth_;        ///< of the newest frame
  cv::Mat original_;     ///< the mask as it was given
  int mask_frame_ = -1;  ///< its frame; -1: there is no mask
  std::vector<MaskTile> tiles_;
};

}  // namespace stdc
