#include <fmt/format.h>
#include <pybind11/stl.h>

#include <sstream>

#include "arrays.hpp"
#include "bindings.hpp"
#include "core/error.hpp"
#include "core/files/whole_file.hpp"
#include "evaluation/trajectory_error.hpp"
#include "trajectory.hpp"

namespace stdc::python {
namespace {

PyTrajectory of_arrays(const py::array_t<double>& timestamps, const py::array_t<double>& poses) {
  if (timestamps.ndim() != 1 || poses.ndim() != 3 || poses.shape(0) != timestamps.shape(0)) {
    throw Error("Trajectory", "times and poses do not fit together",
                "give N times [s] and N x 4 x 4 world_from_cam");
  }
  PyTrajectory result;
  for (py::ssize_t i = 0; i < timestamps.shape(0); ++i) {
    result.poses.push_back({timestamps.at(i), pose_of(poses[py::int_(i)], fmt::format("pose {}", i))});
  }
  return result;
}

py::dict dict_of(const ErrorStatistics& s) {
  py::dict dict;
  dict["rmse"] = s.rmse, dict["mean"] = s.mean, dict["median"] = s.median, dict["max"] = s.maximum;
  return dict;
}

py::object dict_of(const TrajectoryScores::Statistics& s) { return s ? py::object(dict_of(*s)) : py::none(); }

}  // namespace

PyTrajectory trajectory_of(const std::vector<FramePose>& poses) {
  PyTrajectory result;
  for (const FramePose& pose : poses) result.poses.push_back({pose.timestamp, pose.world_from_cam});
  return result;
}

Trajectory trajectory_given(const py::handle& object, const std::string& where) {
  if (py::isinstance<PyTrajectory>(object)) return object.cast<const PyTrajectory&>().poses;
  if (!py::isinstance<py::array>(object)) return read_trajectory(path_of(object));
  const auto rows = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(object);
  if (!rows || rows.ndim() != 2 || rows.shape(1) != 8)
    throw Error(where, "is no N x 8 array", "give rows of timestamp tx ty tz qx qy qz qw");
  std::ostringstream text;  // checked as a file is
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    for (py::ssize_t j = 0; j < 8; ++j) text << fmt::format("{}{}", rows.at(i, j), j < 7 ? ' ' : '\n');
  }
  std::istringstream stream(text.str());
  return read_trajectory(stream, where);
}

void bind_trajectory(py::module_& module) {
  py::class_<PyTrajectory>(module, "Trajectory", "Poses over time.")
      .def(py::init(&of_arrays), py::arg("timestamps"), py::arg("world_from_cam"),
           "N times [s], N x 4 x 4 poses.")
      .def_static(
          "read", [](const py::object& path) { return PyTrajectory{read_trajectory(path_of(path))}; },
          py::arg("path"), "Reads a file in TUM format.")
      .def(
          "save",
          [](const PyTrajectory& t, const py::object& path) {
            WholeFile file(path_of(path));
            file.stream() << format_trajectory(t.poses);
            file.commit();
          },
          py::arg("path"), "Writes TUM format: timestamp tx ty tz qx qy qz qw.")
      .def("__len__", [](const PyTrajectory& t) { return t.poses.size(); })
      .def("__str__", [](const PyTrajectory& t) { return format_trajectory(t.poses); })
      .def_property_readonly(
          "timestamps",
          [](const PyTrajectory& t) {
            std::vector<double> times;
            for (const StampedPose& pose : t.poses) times.push_back(pose.timestamp);
            return py::array_t<double>(static_cast<py::ssize_t>(times.size()), times.data());
          },
          "N [s]")
      .def_property_readonly(
          "world_from_cam",
          [](const PyTrajectory& t) {
            std::vector<Pose> poses;
            for (const StampedPose& pose : t.poses) poses.push_back(pose.world_from_cam);
            return array_of(poses);
          },
          "N x 4 x 4")
      .def_property_readonly(
          "positions",
          [](const PyTrajectory& t) {
            std::vector<Eigen::Vector3d> positions;
            for (const StampedPose& pose : t.poses) positions.push_back(pose.world_from_cam.translation);
            return rows_of<double>(positions, 3);
          },
          "N x 3 [m], camera centres in the world");

  module.def(
      "evaluate",
      [](const py::object& truth, const py::object& estimate, double max_difference) {
        const Trajectory true_one = trajectory_given(truth, "truth"),
                         given = trajectory_given(estimate, "estimate");
        const TrajectoryScores scores = score_trajectory(true_one, given, max_difference);
        py::dict result;
        result["pairs"] = scores.pairs;
        result["ate"] = dict_of(scores.ate);
        result["rpe_frame_translation"] = dict_of(scores.rpe_frame_translation);
        result["rpe_frame_rotation"] = dict_of(scores.rpe_frame_rotation);
        result["rpe_second_translation"] = dict_of(scores.rpe_second_translation);
        result["rpe_second_rotation"] = dict_of(scores.rpe_second_rotation);
        result["coverage"] = scores.coverage;
        result["scale"] = scores.scale.factor;
        result["ate_with_scale"] = scores.scale.ate_rmse;
        result["truth_from_estimate"] = array_of(scores.truth_from_estimate);
        return result;
      },
      py::arg("truth"), py::arg("estimate"), py::arg("max_difference") = 0.02,
      "Scores an estimate as TUM's tools and evo do: ATE after SE(3) alignment [m], relative errors [m, "
      "deg]. scale: of the estimate's size to the truth's by the best similarity; ate_with_scale: RMSE after "
      "it [m].\n\n"
      "Each a Trajectory, a file in TUM format, or an N x 8 array of its columns. Returns a dict.");
}

}  // namespace stdc::python
