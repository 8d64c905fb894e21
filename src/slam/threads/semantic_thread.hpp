#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/camera.hpp"
#include "core/rgbd_image.hpp"
#include "segmentation/propagation/mask_propagator.hpp"
#include "segmentation/segmentation_settings.hpp"
#include "segmentation/segmenter.hpp"
#include "segmentation/srm/refinement.hpp"
#include "slam/threads/worker.hpp"
#include "slam/tracking_result.hpp"

namespace stdc {

/// What is known of the dynamic pixels of a frame.
struct DynamicMask {
  cv::Mat mask;  ///< CV_8UC1, 255 = dynamic; empty: nothing is known
  SegmentationReport report;
};

/// Segments frames beside the tracker, carries masks to later frames and completes them by depth (Alg. 1).
///
/// In the pace `every-frame` each frame waits for its own mask; a frame that got none is given the one of the
/// frame before, carried over. While nobody has been seen for `idle_after` seconds, the network looks only at
/// as many frames as it must so that a newcomer is masked within `idle_interval` seconds. In the pace
/// `asynchronous` the segmentation of frame k is collected at frame k + latency, and the next one starts
/// there, with the newest frame; in between the mask is carried. Which mask a frame gets depends on frame
/// counts and the images' times only, never on clocks.
class SemanticThread {
 public:
  SemanticThread(const Camera& camera, const SegmentationSettings& settings,
                 const RefinementSettings& refinement, const PropagationSettings& propagation,
                 std::unique_ptr<Segmenter> segmenter);

  /// Starts the work on a frame.
  /// @param grey             the colour image in grey
  /// @param frame_from_last  how the camera has moved since the last call, as far as that can be foretold
  void begin(const RgbdImage& image, const cv::Mat& grey, int frame,
             const std::optional<Pose>& frame_from_last = {});
  /// The mask of the frame of the last begin(), waiting for it.
  DynamicMask finish();

 private:
  struct Segmented {
    int frame = 0;
    double timestamp = 0;
    cv::Mat mask;  ///< as segmented; empty: there is none
    double milliseconds = 0;
  };

  void segment(const RgbdImage& image, int frame);
  void collect();
  bool may_rest(double timestamp) const;
  void move_mask(const std::optional<Pose>& frame_from_last);
  void complete_mask();
  cv::Mat moved_mask() const;

  SegmentationSettings settings_;
  RefinementSettings refinement_;
  double depth_units_per_metre_;
  std::unique_ptr<Segmenter> segmenter_;
  MaskPropagator propagator_;
  std::optional<int> in_flight_;  ///< frame that is being segmented
  Segmented segmented_;           ///< the last one; belongs to the segmenting thread while in flight
  cv::Mat mask_;                  ///< the last mask collected, unmoved
  int mask_frame_ = -1;           ///< the frame it belongs to; -1: none yet
  bool mask_is_new_ = false;      ///< the propagator does not know it yet
  double segmented_time_ = 0;     ///< of the last image that was segmented [s]
  std::optional<double> last_time_, empty_since_;  ///< of the last image; since when nobody has been seen [s]
  RgbdImage image_;                                ///< of the present frame
  cv::Mat grey_;
  int frame_ = 0;
  DynamicMask result_;
  Worker segmenting_, carrying_;  // last, so that they end before what they work on
};

}  // namespace stdc
