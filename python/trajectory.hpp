#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "input/trajectory.hpp"
#include "slam/tracking_result.hpp"

namespace stdc::python {

/// A trajectory as Python sees it.
struct PyTrajectory {
  Trajectory poses;
};

PyTrajectory trajectory_of(const std::vector<FramePose>& poses);
/// Of a PyTrajectory, an N x 8 array (TUM's columns) or a file in TUM format. Throws Error naming `where`.
Trajectory trajectory_given(const pybind11::handle& object, const std::string& where);

}  // namespace stdc::python
