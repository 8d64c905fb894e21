#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration_problem.hpp"

namespace stdc {

/// A value that was estimated.
struct CalibratedValue {
  CalibrationParameter parameter{};
  double given = 0, value = 0;  ///< units of CalibrationValues
  double sigma = 0;             ///< standard deviation
  bool seen = false;            ///< the recording tells it; otherwise `value` is the given one
};

struct Calibration {
  CalibrationValues values{};
  std::vector<CalibratedValue> estimates;  ///< of what was asked for
  int keyframes = 0, points = 0, observations = 0;
};

/// Finds the values with which a scene fits together best: minimises the cost of CalibrationProblem over them
/// by fitting a quadratic to it, round after round (the poses and points are always at their best: a profile
/// of the likelihood; Pawitan, 'In All Likelihood', 2001, ch. 3). The sigma is the larger of what the
/// curvature says and of a jackknife over groups of points and over stretches of time (Efron, 'The
/// Jackknife', 1982).
/// @param given   values to start from
/// @param wanted  what to estimate; the rest stays as given
/// @param on_fit  called for each quadratic, with its number; there are 15 to 25
Calibration calibrate(const CalibrationScene& scene, const CalibrationValues& given,
                      const std::vector<CalibrationParameter>& wanted,
                      const std::function<void(int)>& on_fit = {});

}  // namespace stdc
