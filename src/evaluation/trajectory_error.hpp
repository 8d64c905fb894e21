#pragma once

#include <optional>
#include <vector>

#include "input/trajectory.hpp"

namespace stdc {

/// Of at least one error; where there is none, there are no statistics.
struct ErrorStatistics {
  double rmse = 0, mean = 0, median = 0, maximum = 0;
};

/// The similarity (Sim(3)) that aligns an estimate best. RGB-D has no free scale: one that is far from 1
/// tells of wrong units of depth or of a wrong focal length.
struct ScaleFit {
  double factor = 1;    ///< of the estimate's size to the truth's: 0.97 if the estimate is 3 % too large
  double ate_rmse = 0;  ///< with the estimate enlarged by it [m]

  /// Whether the scale is off by more than 1 % and explains more than a third of the error.
  bool is_suspicious(double rigid_rmse) const;
};

/// Errors of an estimated trajectory against the truth.
struct TrajectoryScores {
  using Statistics = std::optional<ErrorStatistics>;

  int pairs = 0;                      ///< poses of the estimate that found a true one
  int off_by_5_cm = 0;                ///< of which more than 5 cm from the truth after the alignment
  ErrorStatistics ate;                ///< absolute trajectory error after SE(3) alignment [m]
  Statistics rpe_frame_translation;   ///< relative error from pair to next pair [m]
  Statistics rpe_frame_rotation;      ///< the same [deg]
  Statistics rpe_second_translation;  ///< over one second [m]; nothing where no two pairs lie a second apart
  Statistics rpe_second_rotation;     ///< the same [deg]
  /// Share of the truth's time span, or of `frames`, that has a pose, 0..1; nothing if that is empty.
  std::optional<double> coverage;
  Pose truth_from_estimate;  ///< the alignment
  ScaleFit scale;            ///< what the scale alone has to do with the ATE
};

/// Scores an estimate as TUM's tools and evo do: pairs at most `max_difference` seconds apart, SE(3) Umeyama
/// alignment (ATE; Sturm et al., IROS 2012), relative errors between pairs. Throws Error if fewer than 3
/// pairs. `frames`: number of input frames, for the coverage of a run.
TrajectoryScores score_trajectory(const Trajectory& truth, const Trajectory& estimate,
                                  double max_difference = 0.02, std::optional<int> frames = {});

/// The distance of a pose from the true one of its time.
struct PoseError {
  double timestamp = 0;  ///< [s], of the estimate
  double distance = 0;   ///< [m], after the alignment
};

/// The errors that the ATE is made of, in order of time.
/// @param truth_from_estimate  the alignment that score_trajectory() found
std::vector<PoseError> pose_errors(const Trajectory& truth, const Trajectory& estimate,
                                   const Pose& truth_from_estimate, double max_difference = 0.02);

}  // namespace stdc
