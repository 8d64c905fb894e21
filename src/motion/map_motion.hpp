#pragma once

#include <deque>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/camera.hpp"
#include "motion/flow/followed_points.hpp"
#include "motion/motion_belief.hpp"
#include "motion/motion_detector.hpp"
#include "motion/static_scene.hpp"

namespace stdc {

/// Motion method `map`: what is known of the static scene is compared with what is seen. A surface that
/// stands where free space was seen moves until it has proved to rest.
class MapMotion : public MotionDetector {
 public:
  MapMotion(const Camera& camera, const MotionSettings& settings);

  void follow(const AtlasSnapshot& snapshot) override;
  std::vector<LandmarkId> observe(const MotionFrame& frame, const SmallFrame& small,
                                  const std::vector<MaskTile>& tiles) override;
  std::optional<PoseAgreement> agreement(const Pose& cam_from_world, MapId map, const SmallFrame& small,
                                         const cv::Mat& depth, const cv::Mat& expected) const override;
  cv::Mat mask() const override;
  cv::Mat moving_now(const cv::Mat& mask) const override;
  cv::Mat doubtful() const override;

  const StaticScene& scene() const { return scene_; }

 private:
  std::vector<CellSource> sources(const std::vector<MaskTile>& tiles) const;
  std::vector<std::uint8_t> cells_of(const std::vector<Eigen::Vector2f>& pixels) const;
  std::vector<std::uint8_t> inner_cells(std::vector<std::uint8_t> cells, const DepthGrid& grid) const;
  std::vector<std::uint8_t> find_moving_points(const MotionFrame& input, const DepthGrid& grid);
  std::vector<std::uint8_t> moving_cells() const;
  std::vector<LandmarkId> find_gone(const SceneFrame& frame,
                                    const std::vector<MissingLandmark>& missing) const;
  bool is_young(double timestamp, double seconds) const;
  void find_resting(const SceneFrame& frame, const std::vector<std::uint8_t>& segmented);
  void remember(const SceneFrame& frame, const std::vector<CellFinding>& findings,
                const std::vector<std::uint8_t>& segmented);

  Camera camera_;
  MotionSettings settings_;
  GridGeometry geometry_;
  StaticScene scene_;
  MotionBelief belief_;
  FollowedPoints points_;
  static constexpr std::size_t kLag = 5;  ///< [frames] between those compared for what recedes
  static constexpr double kYoung = 3;     ///< [s] in which a map begins
  static constexpr double kPause = 0.5;   ///< [s] after which a thing that has stopped is seen to stand
  std::optional<SceneFrame> last_;
  std::deque<SceneFrame> recent_;       ///< of the last kPause, and at least kLag frames
  std::vector<std::uint8_t> doubtful_;  ///< cells of the last frame that may move
  std::vector<std::uint8_t> resting_;   ///< cells of the last frame that do not move at present, or empty
  cv::Mat depth_;
};

}  // namespace stdc
