#include <pybind11/stl.h>

#include <mutex>

#include "arrays.hpp"
#include "bindings.hpp"
#include "core/error.hpp"
#include "features/extractor.hpp"
#include "released_gil.hpp"
#include "segmentation/network/network_segmenter.hpp"
#include "segmentation/srm/refinement.hpp"

namespace stdc::python {
namespace {

/// The network with the SRM behind it. One image at a time.
class PySegmenter {
 public:
  PySegmenter(const py::object& weights, const py::object& given)
      : settings_(settings_of(given)),
        segmenter_(weights.is_none() ? find_network_weights() : std::filesystem::path(path_of(weights)),
                   settings_.network) {}

  py::object segment(const py::object& colour, const py::object& depth, double units,
                     const std::string& order) {
    const SegmenterInput input{colour_image(colour, order, "colour"), 0, 0};
    const cv::Mat depths = depth_image(depth, "depth");
    cv::Mat mask;
    {
      const ReleasedGil others;
      const std::lock_guard lock(mutex_);
      mask = segmenter_.segment(input);
      if (!depths.empty() && !mask.empty()) mask = refine(mask, depths, units, settings_.refinement);
    }
    return array_of(mask);
  }
  const std::vector<std::string>& classes() const { return segmenter_.classes(); }
  std::string description() const { return segmenter_.description(); }

 private:
  Settings settings_;
  NetworkSegmenter segmenter_;
  std::mutex mutex_;
};

Features extract(const py::object& image, const py::object& mask, const py::object& given,
                 const std::string& order) {
  const cv::Mat grey = grey_image(image, order, "image");
  const cv::Mat dynamic = mask_image(mask, "mask");
  if (!dynamic.empty() && dynamic.size() != grey.size())
    throw Error("mask", "has another size than the image", "give one of the same height and width");
  const Settings settings = settings_of(given);
  const ReleasedGil others;
  FeatureExtractor extractor(settings.features);
  extractor.detect(grey);
  extractor.reject(dynamic);
  return extractor.select();
}

template <typename T, typename Member>
py::array_t<T> column(const Features& features, Member member) {
  py::array_t<T> array(static_cast<py::ssize_t>(features.keypoints.size()));
  for (std::size_t i = 0; i < features.keypoints.size(); ++i)
    array.mutable_at(i) = static_cast<T>(features.keypoints[i].*member);
  return array;
}

}  // namespace

void bind_tools(py::module_& module) {
  py::class_<PySegmenter>(module, "Segmenter",
                          "Finds people and other dynamic classes with the STDC network.")
      .def(py::init<const py::object&, const py::object&>(), py::arg("weights") = py::none(),
           py::arg("settings") = py::none(), "weights: .safetensors; None: those that ship.")
      .def("__call__", &PySegmenter::segment, py::arg("colour"), py::arg("depth") = py::none(), py::kw_only(),
           py::arg("depth_units_per_metre") = 1000.0, py::arg("order") = "rgb",
           "Mask of what moves by itself: H x W uint8, 255 = dynamic. With depth the SRM completes it.")
      .def_property_readonly("classes", &PySegmenter::classes)
      .def_property_readonly("description", &PySegmenter::description);

  py::class_<Features>(module, "Features", "ORB features of an image; all arrays in the same order.")
      .def("__len__", [](const Features& f) { return f.keypoints.size(); })
      .def_property_readonly(
          "keypoints", [](const Features& f) { return pixels_of(f.keypoints); }, "N x 2 float32 [px]")
      .def_property_readonly(
          "angles", [](const Features& f) { return column<float>(f, &Keypoint::angle); }, "N [rad]")
      .def_property_readonly("responses",
                             [](const Features& f) { return column<float>(f, &Keypoint::response); })
      .def_property_readonly("levels",
                             [](const Features& f) { return column<std::uint8_t>(f, &Keypoint::level); })
      .def_property_readonly(
          "high_quality", [](const Features& f) { return column<bool>(f, &Keypoint::quality); },
          "N bool: passed FAST's high threshold")
      .def_property_readonly(
          "descriptors", [](const Features& f) { return rows_of<std::uint8_t>(f.descriptors, 32); },
          "N x 32 uint8, for Hamming distance");

  module.def("extract_features", &extract, py::arg("image"), py::kw_only(), py::arg("mask") = py::none(),
             py::arg("settings") = py::none(), py::arg("order") = "rgb",
             "The paper's improved quadtree ORB. image: uint8, H x W or H x W x 3. mask: not 0 = dynamic, "
             "rejected.");
}

}  // namespace stdc::python
