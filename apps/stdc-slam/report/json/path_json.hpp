#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "evaluation/trajectory_error.hpp"

namespace stdc::app {

/// Where a camera went, for the page.
struct ReportPaths {
  Trajectory estimate, keyframes;          ///< in the world of the estimate
  std::vector<Eigen::Vector3d> landmarks;  ///< [m], in the same world
  Trajectory truth;                        ///< in the usual convention; empty: there is none
  std::optional<Pose> truth_from_estimate;
  std::vector<PoseError> errors;  ///< of the estimate
  int rotation = 0;               ///< Camera::rotation
};

/// The frame in which a path is drawn: z up, as far as that can be told from how the camera was held; that of
/// the ground truth if the estimate is aligned to one.
class DrawingFrame {
 public:
  explicit DrawingFrame(const ReportPaths& paths);
  /// A position in the world of the estimate.
  Eigen::Vector3d operator()(const Eigen::Vector3d& position) const {
    return drawn_from_world_ * (world_from_estimate_ * position);
  }
  /// A true position.
  Eigen::Vector3d of_truth(const Eigen::Vector3d& position) const { return drawn_from_world_ * position; }
  /// Names of its axes in the world, {"x": "x", "y": "z", "z": "-y", "world": words}.
  nlohmann::ordered_json names() const;

 private:
  bool of_truth_;
  Pose world_from_estimate_;
  Eigen::Matrix3d drawn_from_world_;  ///< axes exchanged and turned round
};

/// Adds "axes", "trajectory", "truth", "keyframes", "landmarks" and "length_m" to a run of the page.
/// @param first_time  [s]; times in the page count from there
void add_paths(nlohmann::ordered_json& run, const ReportPaths& paths, double first_time);

}  // namespace stdc::app
