#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "evaluation/truth_convention.hpp"
#include "input/trajectory.hpp"

namespace stdc {

/// The ground truth beside a trajectory that grows: moved to where it fits best.
class AlignedTruth {
 public:
  /// @param truth  as recorded
  explicit AlignedTruth(Trajectory truth) : recorded_(std::move(truth)) {}

  struct Fit {
    std::vector<Eigen::Vector3d> positions;  ///< in the estimate's world [m], up to the newest pose
    std::optional<double> ate;               ///< [m] RMSE
  };
  /// How it fits the poses of one map; nothing where it cannot be said yet.
  Fit fit(const Trajectory& estimate);

 private:
  Trajectory recorded_, usual_;    ///< as it is, and in the usual convention
  std::size_t recognised_at_ = 0;  ///< poses of the estimate by which the convention was recognised
};

}  // namespace stdc
