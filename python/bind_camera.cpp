#include <fmt/format.h>

#include "bindings.hpp"
#include "core/camera.hpp"
#include "core/error.hpp"
#include "input/camera_file.hpp"

namespace stdc::python {
namespace {

Camera make_camera(int width, int height, double fx, double fy, double cx, double cy,
                   double depth_units_per_metre, const py::kwargs& more) {
  Camera camera;
  camera.width = width, camera.height = height;
  camera.fx = fx, camera.fy = fy, camera.cx = cx, camera.cy = cy;
  camera.depth_units_per_metre = depth_units_per_metre;
  for (const auto& [key, value] : more) {
    const std::string name = key.cast<std::string>();
    if (!py::hasattr(py::type::of<Camera>(), name.c_str()))
      throw Error("Camera", "has no '" + name + "'", "see help(stdc_slam.Camera)");
    py::cast(&camera, py::return_value_policy::reference).attr(name.c_str()) = value;
  }
  camera.validate("Camera");
  return camera;
}

}  // namespace

void bind_camera(py::module_& module) {
  py::class_<Camera> camera(
      module, "Camera",
      "An RGB-D camera; the depth is registered to the colour image.\n\n"
      "Pixel (0, 0) is the centre of the top left pixel. Lens distortion as OpenCV has it.");
  camera
      .def(py::init(&make_camera), py::arg("width"), py::arg("height"), py::arg("fx"), py::arg("fy"),
           py::arg("cx"), py::arg("cy"), py::arg("depth_units_per_metre") = 1000.0,
           "Further keywords: k1, k2, p1, p2, k3, k4, k5, k6, lens, readout_time [s], frames_per_second, "
           "rotation.")
      .def_static(
          "read", [](const py::object& path) { return read_camera(path_of(path)); }, py::arg("path"),
          "Reads a camera.yaml.")
      .def_readwrite("width", &Camera::width, "[px]")
      .def_readwrite("height", &Camera::height, "[px]")
      .def_readwrite("fx", &Camera::fx, "[px]")
      .def_readwrite("fy", &Camera::fy, "[px]")
      .def_readwrite("cx", &Camera::cx, "[px]")
      .def_readwrite("cy", &Camera::cy, "[px]")
      .def_readwrite("k1", &Camera::k1)
      .def_readwrite("k2", &Camera::k2)
      .def_readwrite("p1", &Camera::p1)
      .def_readwrite("p2", &Camera::p2)
      .def_readwrite("k3", &Camera::k3)
      .def_readwrite("k4", &Camera::k4)
      .def_readwrite("k5", &Camera::k5)
      .def_readwrite("k6", &Camera::k6)
      .def_readwrite("depth_units_per_metre", &Camera::depth_units_per_metre, "of 16-bit depth images")
      .def_readwrite("frames_per_second", &Camera::frames_per_second)
      .def_readwrite("readout_time", &Camera::readout_time, "[s], of a rolling shutter; 0: global shutter")
      .def_readwrite("rotation", &Camera::rotation, "degrees clockwise that turn the image upright")
      .def_property(
          "lens", [](const Camera& c) { return std::string(c.lens_name()); },
          [](Camera& c, const std::string& name) {
            if (name != "equidistant" && name != "brown-conrady") {
              throw Error(
                  "Camera.lens", "'" + name + "' is none",
                  "say \"equidistant\" or \"brown-conrady\"; pinhole, radial-tangential and rational follow "
                  "from the coefficients");
            }
            c.lens = name == "equidistant" ? LensModel::equidistant : LensModel::brown_conrady;
          })
      .def("__eq__", &Camera::operator==)
      .def("__repr__", [](const Camera& c) {
        return fmt::format("<stdc_slam.Camera {}x{}, f {:.1f} {:.1f} px, {}>", c.width, c.height, c.fx, c.fy,
                           c.lens_name());
      });
}

}  // namespace stdc::python
