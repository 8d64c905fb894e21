#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/camera.hpp"
#include "motion/depth_growth.hpp"
#include "motion/motion_detector.hpp"
#include "motion/motion_settings.hpp"
#include "motion/multi_view/keyframe_points.hpp"

namespace stdc {

/// Motion method `multi-view`: keypoints of earlier keyframes are projected into the frame; where it shows
/// something that is much nearer, that is dynamic. After Bescos, Facil, Civera and Neira, 'DynaSLAM:
/// Tracking, Mapping, and Inpainting in Dynamic Scenes', RA-L 2018, section III-C:
///
/// - The keyframes that overlap the frame most are used, five of them (`multi_view_keyframes`).
/// - A point that is seen under a parallax of more than 30 degrees (`multi_view_parallax`) may be hidden and
///   does not count.
/// - z_proj is its depth as projected, z' the depth that the frame measures there. If z_proj - z' is above
///   tau_z = 0.4 m (`multi_view_tau`) it is dynamic.
/// - A dynamic point is taken back if the depth around it varies much: it lies on an outline.
/// - From the dynamic points regions grow in the depth image.
/// - Keyframes give no points where they were found to be dynamic, by this method or a segmenter.
///
/// Where the paper is silent, this was chosen:
/// - Overlap: how many of a keyframe's points the frame has in view, which takes distance and rotation in.
/// - Keypoints: the cells with most contrast of a grid of 3 x 3 cells of about 4 px, on one surface.
/// - 'Taking into account the reprojection error': z' is the farthest depth of the cells around.
/// - Depth varies much: the standard deviation in 5 x 5 cells is above 0.15 m.
/// - Several points in one place: the majority counts, among them those whose depth is as projected;
///   else what a static thing hides from a new side would be dynamic though other keyframes know that thing.
/// - How far regions grow: see grow_in_depth(). Points whose depth is as projected hold them up, so that they
///   do not run along the floor. A region needs `multi_view_min_points` dynamic points.
/// - Whatever changes by less than tau_z is not found: a board that slides in front of a wall near by, a
///   surface that recedes. That is the paper's threshold.
///
/// A frame without a pose has nothing dynamic; neither has one without depth.
class MultiViewMotion : public MotionDetector {
 public:
  /// Throws Error if a setting is out of range.
  MultiViewMotion(const Camera& camera, const MotionSettings& settings);

  void follow(const AtlasSnapshot& snapshot) override;
  std::vector<LandmarkId> observe(const MotionFrame& frame, const SmallFrame& small,
                                  const std::vector<MaskTile>& tiles) override;
  cv::Mat mask() const override;

 private:
  void find_moving(const DepthGrid& grid, const Pose& cam_from_world, MapId map);
  std::vector<GrowthSeed> seeds(const DepthGrid& grid, const Pose& cam_from_world, MapId map) const;
  bool is_uncertain(const DepthGrid& grid, int x, int y) const;

  Camera camera_;
  MotionSettings settings_;
  GridGeometry geometry_;
  KeyframeStore keyframes_;
  /// The last frame, in case that it becomes a keyframe: the map decides after it was observed.
  std::optional<KeyframePoints> last_;
  std::size_t known_keyframes_ = 0;   ///< of the map, removed ones included
  std::vector<std::uint8_t> moving_;  ///< of each cell
  cv::Mat depth_;                     ///< of the last frame
};

}  // namespace stdc
