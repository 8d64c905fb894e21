#include <fmt/format.h>
#include <pybind11/stl.h>

#include <atomic>
#include <mutex>

#include "arrays.hpp"
#include "bindings.hpp"
#include "core/error.hpp"
#include "input/camera_file.hpp"
#include "input/frame_decoder.hpp"
#include "input/open_source.hpp"
#include "input/shifted_depth.hpp"
#include "released_gil.hpp"
#include "trajectory.hpp"

namespace stdc::python {
namespace {

/// A frame with its images.
struct InputFrame {
  RgbdImage image;
  std::string name;
};

/// An input of any kind that the command line reads. One thread at a time.
class Input {
 public:
  Input(const std::string& path, const SourceOptions& options, const std::optional<std::string>& camera,
        bool grey)
      : source_(open_source(path, options)), mode_(grey ? ColourMode::grey : ColourMode::as_stored) {
    if (camera) {
      cameras_ = read_cameras(*camera);
    } else if (const auto known = source_->cameras()) {
      cameras_ = *known;
    } else {
      throw Error(source_->where(), "no camera is known", source_->camera_hint());
    }
    if (cameras_.depth_time_offset != 0) source_ = shift_depth(std::move(source_), cameras_.depth_time_offset);
    decoder_.emplace(cameras_);
  }

  InputFrame next() {
    std::optional<InputFrame> frame;
    {
      const ReleasedGil others;
      const std::lock_guard lock(mutex_);
      if (const auto packed = source_->next())
        frame = InputFrame{decoder_->decode(*packed, mode_), packed->name};
    }
    if (!frame) throw py::stop_iteration();
    return std::move(*frame);
  }
  void rewind() {
    const std::lock_guard lock(mutex_);
    if (used_.exchange(true)) {
      if (!source_->can_rewind())
        throw Error(source_->where(), "was read before and cannot be rewound", "open it again");
      source_->rewind();
    }
  }
  const Camera& camera() const { return cameras_.colour; }
  FrameSource& source() { return *source_; }

 private:
  std::unique_ptr<FrameSource> source_;
  RgbdCameras cameras_;
  ColourMode mode_;
  std::optional<FrameDecoder> decoder_;
  std::mutex mutex_;
  std::atomic<bool> used_ = false;
};

}  // namespace

void bind_input(py::module_& module) {
  py::class_<InputFrame>(module, "Frame", "Colour and registered depth of one time.")
      .def_property_readonly(
          "timestamp", [](const InputFrame& f) { return f.image.timestamp; }, "[s]")
      .def_property_readonly(
          "colour", [](const InputFrame& f) { return array_of(f.image.colour); },
          "uint8, H x W x 3 (RGB) or H x W")
      .def_property_readonly(
          "depth", [](const InputFrame& f) { return array_of(f.image.depth); },
          "uint16 in the camera's units, or float32 [m]; H x W; 0 = missing")
      .def_readonly("name", &InputFrame::name, "stem of the image's file, or its time");

  py::class_<Input>(module, "Input", "A recording; iterate over it for its frames. See open_input().")
      .def_property_readonly("camera", &Input::camera, py::return_value_policy::copy)
      .def_property_readonly("kind", [](Input& i) { return i.source().kind(); })
      .def_property_readonly(
          "notes", [](Input& i) { return i.source().notes(); },
          "what ought to be known of how the input was understood")
      .def_property_readonly(
          "faults", [](Input& i) { return i.source().faults(); }, "what was wrong with the data so far")
      .def_property_readonly(
          "ground_truth",
          [](Input& i) -> std::optional<PyTrajectory> {
            const auto truth = i.source().ground_truth();
            if (!truth || truth->poses.empty()) return std::nullopt;
            return PyTrajectory{truth->poses};
          },
          "Trajectory, or None")
      .def("__len__",
           [](Input& i) {
             const auto count = i.source().frame_count();
             if (!count) throw py::type_error("how many frames there are is not known before the end");
             return *count;
           })
      .def(
          "__iter__",
          [](Input& i) -> Input& {
            i.rewind();
            return i;
          },
          py::return_value_policy::reference_internal)
      .def("__next__", &Input::next);

  module.def(
      "open_input",
      [](const py::object& path, const std::string& kind, std::optional<double> rate,
         const py::object& camera, bool grey) {
        SourceOptions options;
        options.kind = kind;
        options.rate = rate;
        return std::make_unique<Input>(
            path_of(path), options, camera.is_none() ? std::nullopt : std::optional(path_of(camera)), grey);
      },
      py::arg("path"), py::kw_only(), py::arg("kind") = "", py::arg("rate") = py::none(),
      py::arg("camera") = py::none(), py::arg("grey") = false,
      "Opens a recording: any file or folder that `stdc-slam info` knows.\n\n"
      "camera: a camera.yaml that goes before what the input says. grey: luma instead of RGB, half the time "
      "of "
      "decoding; the tracker needs no more without the network.");
}

}  // namespace stdc::python
