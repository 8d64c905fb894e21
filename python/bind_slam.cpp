#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <opencv2/core.hpp>

#include "arrays.hpp"
#include "bindings.hpp"
#include "dense/mesh/triangle_mesh.hpp"
#include "released_gil.hpp"
#include "slam/make_segmenter.hpp"
#include "slam_object.hpp"
#include "trajectory.hpp"

namespace stdc::python {
namespace {

using Times = py::dict;

Times times_of(const StageTimes& t) {
  Times times;
  times["extraction"] = t.extraction, times["mask_wait"] = t.mask_wait, times["rejection"] = t.rejection;
  times["prediction"] = t.prediction, times["local_map"] = t.local_map,
  times["relocalisation"] = t.relocalisation;
  times["keyframe"] = t.keyframe, times["wait"] = t.wait, times["total"] = t.total,
  times["total_cpu"] = t.total_cpu;
  return times;
}

void bind_result(py::module_& module) {
  py::enum_<TrackingStatus>(module, "Status", "What became of a frame.")
      .value("initialising", TrackingStatus::initialising, "no map yet: too few keypoints with depth so far")
      .value("ok", TrackingStatus::ok, "it has a pose")
      .value("uncertain", TrackingStatus::uncertain,
             "it has a pose that too little of the static scene agrees with")
      .value("lost", TrackingStatus::lost, "it has none; tracking goes on trying")
      .value("skipped", TrackingStatus::skipped, "not processed: a time that is not later than the last");

  using Result = TrackingResult;
  const auto pose = [](const std::optional<Pose>& p) { return p ? py::object(array_of(*p)) : py::none(); };
  py::class_<Result>(module, "TrackingResult", "What track() tells about a frame.")
      .def_readonly("frame", &Result::frame, "counts calls of track()")
      .def_readonly("timestamp", &Result::timestamp, "[s]")
      .def_readonly("status", &Result::status)
      .def_property_readonly(
          "cam_from_world", [pose](const Result& r) { return pose(r.cam_from_world); },
          "4 x 4, or None without a pose; the world is the map's first camera")
      .def_property_readonly(
          "world_from_cam",
          [pose](const Result& r) {
            return pose(r.cam_from_world ? std::optional(r.cam_from_world->inverse()) : std::nullopt);
          },
          "4 x 4, or None: where the camera is")
      .def_property_readonly(
          "covariance", [](const Result& r) { return r.covariance; },
          "6 x 6, or None: of a twist (translation [m], rotation [rad]) on the left of cam_from_world")
      .def_property_readonly("map",
                             [](const Result& r) -> std::optional<std::uint32_t> {
                               return r.map.valid() ? std::optional<std::uint32_t>(r.map.value)
                                                    : std::nullopt;
                             })
      .def_readonly("matches", &Result::matches)
      .def_readonly("inliers", &Result::inliers)
      .def_readonly("is_keyframe", &Result::is_keyframe)
      .def_property_readonly(
          "milliseconds", [](const Result& r) { return times_of(r.milliseconds); },
          "dict of the stages' wall times")
      .def_property_readonly(
          "keypoints", [](const Result& r) { return pixels_of(r.keypoints); }, "N x 2 [px]")
      .def_property_readonly(
          "inlier_mask",
          [](const Result& r) {
            py::array_t<bool> array(static_cast<py::ssize_t>(r.keypoint_states.size()));
            for (std::size_t i = 0; i < r.keypoint_states.size(); ++i)
              array.mutable_at(i) = r.keypoint_states[i] == KeypointState::inlier;
            return array;
          },
          "N bool: which keypoints agree with the pose")
      .def_property_readonly(
          "dynamic_mask", [](const Result& r) { return array_of(r.dynamic_mask); },
          "H x W uint8, 255 = moves, or None")
      .def_property_readonly(
          "dynamic_share",
          [](const Result& r) -> std::optional<double> {
            if (r.dynamic_mask.empty()) return std::nullopt;
            return static_cast<double>(cv::countNonZero(r.dynamic_mask)) /
                   static_cast<double>(r.dynamic_mask.total());
          },
          "of the pixels, 0..1, or None")
      .def("__repr__", [](const Result& r) {
        return fmt::format("<stdc_slam.TrackingResult frame {}: {}, {} inliers>", r.frame,
                           std::string(py::str(py::cast(r.status).attr("name"))), r.inliers);
      });
}

void bind_mesh(py::module_& module) {
  py::class_<TriangleMesh>(module, "Mesh", "The surface of the static scene, in the map's world.")
      .def_property_readonly(
          "vertices", [](const TriangleMesh& m) { return rows_of<float>(m.positions, 3); },
          "N x 3 float32 [m]")
      .def_property_readonly(
          "normals", [](const TriangleMesh& m) { return rows_of<float>(m.normals, 3); },
          "N x 3 float32, to the free side")
      .def_property_readonly(
          "colours", [](const TriangleMesh& m) { return rows_of<std::uint8_t>(m.colours, 3); },
          "N x 3 uint8, RGB")
      .def_property_readonly(
          "triangles", [](const TriangleMesh& m) { return rows_of<std::uint32_t>(m.triangles, 3); },
          "M x 3 uint32, counter-clockwise from the free side");
}

std::unique_ptr<SlamObject> make_slam(const Camera& camera, const py::object& given,
                                      const py::object& weights, const py::object& masks, bool report) {
  Settings settings = settings_of(given);
  settings.system.report_keypoints = settings.system.report_keypoints || report;
  settings.system.report_masks = settings.system.report_masks || report;
  SegmenterFiles files;
  if (!weights.is_none()) files.weights = path_of(weights);
  if (!masks.is_none()) {
    files.masks = path_of(masks);
    settings.segmentation.source = SegmentationSource::masks;
  }
  const ReleasedGil others;
  return std::make_unique<SlamObject>(camera, settings, make_segmenter(settings, files, camera.rotation));
}

TrackingResult track(SlamObject& slam, const py::object& timestamp, const py::object& colour,
                     const py::object& depth, const std::string& order) {
  RgbdImage image;
  image.timestamp = seconds_of(timestamp, "timestamp");
  image.colour = (slam.needs_colour() ? colour_image : grey_image)(colour, order, "colour");
  image.depth = depth_image(depth, "depth");
  return slam.with([&](Slam& s) { return s.track(image); });
}

}  // namespace

void bind_slam(py::module_& module) {
  bind_result(module);
  bind_mesh(module);
  py::class_<SlamObject>(module, "Slam",
                         "RGB-D SLAM: frames in, poses out.\n\n"
                         "    slam = stdc_slam.Slam(camera)\n"
                         "    for frame in recording:\n"
                         "        result = slam.track(frame.timestamp, frame.colour, frame.depth)\n"
                         "    slam.finish()\n"
                         "    slam.trajectory().save('trajectory.txt')\n\n"
                         "The same frames and settings give the same results, however fast the machine is. "
                         "Calls from several threads "
                         "wait for each other; other Python threads run meanwhile.")
      .def(py::init(&make_slam), py::arg("camera"), py::arg("settings") = py::none(), py::kw_only(),
           py::arg("weights") = py::none(), py::arg("masks") = py::none(), py::arg("report") = true,
           "settings: dict, YAML text or file; the keys of `stdc-slam settings`. weights: of the network; "
           "None: those "
           "that ship. masks: folder of mask images instead of the network. report: results carry keypoints "
           "and masks.")
      .def("track", &track, py::arg("timestamp"), py::arg("colour"), py::arg("depth"), py::kw_only(),
           py::arg("order") = "rgb",
           "Processes the next frame.\n\n"
           "timestamp: seconds, numpy.datetime64 or datetime. colour: uint8, H x W x 3 or H x W. depth: H x "
           "W, uint16 "
           "in units of the camera, or float in metres; 0 or NaN = missing; None: no depth. order: \"rgb\", "
           "or \"bgr\" "
           "as OpenCV has it. Raises Error for arrays of a wrong type or shape; faults of a camera end in a "
           "status.")
      .def(
          "skip",
          [](SlamObject& slam, const py::object& time) {
            const double seconds = seconds_of(time, "timestamp");
            return slam.with([&](Slam& s) { return s.skip(seconds); });
          },
          py::arg("timestamp"), "Counts a frame that could not be read.")
      .def(
          "finish", [](SlamObject& slam) { slam.with([](Slam& s) { s.finish(); }); },
          "Waits for the workers and collects what they still have; track() may go on afterwards.")
      .def(
          "trajectory",
          [](SlamObject& slam) { return trajectory_of(slam.with([](Slam& s) { return s.trajectory(); })); },
          "Poses of all tracked frames as now optimised.")
      .def("keyframe_trajectory",
           [](SlamObject& slam) {
             return trajectory_of(slam.with([](Slam& s) { return s.keyframe_trajectory(); }));
           })
      .def(
          "landmarks",
          [](SlamObject& slam) {
            return rows_of<double>(slam.with([](Slam& s) { return s.landmark_positions(); }), 3);
          },
          "N x 3 [m], positions in the world of the first map.")
      .def(
          "mesh",
          [](SlamObject& slam, double voxel) {
            return slam.with([&](Slam& s) { return s.mesh({0}, voxel); });
          },
          py::arg("voxel") = 0.0,
          "The dense static map; needs the setting dense.active. voxel [m]; 0: as set.")
      .def(
          "save_map",
          [](SlamObject& slam, const py::object& path) {
            const std::string file = path_of(path);
            slam.with([&](Slam& s) { s.save_map(file); });
          },
          py::arg("path"), "Finishes, then writes the map, whole or not at all.")
      .def(
          "load_map",
          [](SlamObject& slam, const py::object& path) {
            const std::string file = path_of(path);
            slam.with([&](Slam& s) { s.load_map(file); });
          },
          py::arg("path"), "Reads a map, before the first frame.")
      .def_property_readonly("camera", &SlamObject::camera, py::return_value_policy::copy)
      .def_property_readonly("keyframe_count",
                             [](SlamObject& s) { return s.with([](Slam& x) { return x.keyframes(); }); })
      .def_property_readonly("landmark_count",
                             [](SlamObject& s) { return s.with([](Slam& x) { return x.landmarks(); }); })
      .def_property_readonly("map_count",
                             [](SlamObject& s) { return s.with([](Slam& x) { return x.maps(); }); });
}

}  // namespace stdc::python
