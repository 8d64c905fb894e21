#pragma once

#include <deque>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/camera.hpp"
#include "motion/depth_growth.hpp"
#include "motion/flow/static_flow.hpp"
#include "motion/motion_detector.hpp"
#include "motion/motion_settings.hpp"

namespace stdc {

/// Motion method `flow`: points that do not move as the static part does, by optical flow between frames.
/// After Yu et al., 'DS-SLAM: A Semantic Visual SLAM towards Dynamic Environments', IROS 2018, section III-C
/// (moving consistency check), and Long et al., 'PSPNet-SLAM: A Semantic SLAM Detect Dynamic Object by
/// Pyramid Scene Parsing Network', IEEE Access 2021:
///
/// - Corners are followed by sparse pyramidal Lucas-Kanade flow; those at the edge of the image or that look
///   different are left out (DS-SLAM); see follow_patch().
/// - The camera's motion between the two frames is compensated by a homography of the static part, found by
///   RANSAC, whose own error is compensated (PSPNet-SLAM); see StaticFlow.
/// - A point farther than a threshold, 1 px, from where it should be is dynamic: from its epipolar line
///   (DS-SLAM) where its depth is not known, otherwise from the part of it that the depth leaves.
/// - A thing with enough dynamic points is dynamic as a whole (DS-SLAM: a segmented person with more than a
///   number of them).
///
/// Where the papers are silent, this was chosen:
/// - How the error of the homography is modelled: as parallax, in proportion to inverse depth. Depth tells
///   parallax from motion along an epipolar line, which an epipolar check alone cannot see.
/// - The error that is left (blur, changes of view) is measured on the points that agree: the threshold is
///   never below four times their median distance, and a twentieth of a point's flow is added.
/// - Points that were dynamic a frame ago or that a segmenter calls dynamic have no say in what is static.
///   The former stay dynamic down to 0.6 of the threshold.
/// - The frames compared are `flow_lag` apart, else what walks slowly stays below the threshold.
/// - What a thing is without a segmenter: dynamic and static points grow along the surfaces of the depth
///   image, see grow_in_depth(), and a connected region with `flow_min_points` dynamic points, twice as many
///   as static ones, that was there a frame ago is one. A point needs others beside it on the same surface
///   that say the same.
///
/// Needs no pose. Without any depth it finds nothing: parallax could not be told from motion. What covers
/// most of the points when it begins to move is taken for the static part, as in the papers; what stops is
/// static again.
class FlowMotion : public MotionDetector {
 public:
  /// Throws Error if a setting is out of range.
  FlowMotion(const Camera& camera, const MotionSettings& settings);

  void follow(const AtlasSnapshot&) override {}
  std::vector<LandmarkId> observe(const MotionFrame& frame, const SmallFrame& small,
                                  const std::vector<MaskTile>& tiles) override;
  cv::Mat mask() const override;

 private:
  struct Corner {
    cv::Point at;
    FlowPoint flow;
    bool moved = false;  ///< it was dynamic a frame ago
    bool moves = false;
  };
  std::vector<Corner> follow_corners(const SmallFrame& now, const SmallFrame& then,
                                     const std::vector<std::uint8_t>& moved,
                                     const std::vector<std::uint8_t>& segmented) const;
  Eigen::Vector2d ray_of(const Eigen::Vector2f& cell, int scale) const;
  void judge(const StaticFlow& flow, double threshold, std::vector<Corner>& corners) const;
  void complete(const SmallFrame& now, const std::vector<Corner>& corners,
                const std::vector<std::uint8_t>& moved);

  Camera camera_;
  MotionSettings settings_;
  std::deque<SmallFrame> recent_;  ///< the oldest first
  StaticFlow last_flow_;
  std::vector<std::uint8_t> moving_;      ///< of each cell of the last frame
  std::vector<std::uint8_t> candidates_;  ///< before regions were confirmed
  int scale_ = 1;
  cv::Mat depth_;  ///< of the last frame
};

}  // namespace stdc
