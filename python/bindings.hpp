#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "slam/settings.hpp"

namespace stdc::python {

namespace py = pybind11;

// Each adds its part to the module.
void bind_errors(py::module_& module);
void bind_camera(py::module_& module);
void bind_trajectory(py::module_& module);
void bind_input(py::module_& module);
void bind_slam(py::module_& module);
void bind_tools(py::module_& module);

/// Settings of what a user gives: None, a dict ({"features": {"keypoints": 1500}} or {"features.keypoints":
/// 1500}), the path of a YAML file, or YAML text. Throws Error as the command line does.
Settings settings_of(const py::handle& object);

/// A path of text or os.PathLike.
std::string path_of(const py::handle& object);

}  // namespace stdc::python
