#include "bindings.hpp"

PYBIND11_MODULE(_core, module) {
  namespace python = stdc::python;
  module.doc() = "STDC-SLAM's C++ core; use it through the package stdc_slam.";
  python::bind_errors(module);
  python::bind_camera(module);
  python::bind_trajectory(module);
  python::bind_input(module);
  python::bind_slam(module);
  python::bind_tools(module);
}
