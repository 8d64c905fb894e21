#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/pose.hpp"
#include "features/keypoint.hpp"

namespace stdc::python {

namespace py = pybind11;

/// A colour image: uint8, H x W (grey) or H x W x 3. Any strides and byte order. Throws Error naming
/// `where`.
/// @param order  "rgb" or "bgr": of the array; the image is BGR
/// This and the following share the array's memory where nothing has to be converted: the image must not
/// outlive it.
cv::Mat colour_image(const py::handle& array, const std::string& order, const std::string& where);
/// Its brightness, as the tracker would make it of the colour image: one pass less over the pixels.
cv::Mat grey_image(const py::handle& array, const std::string& order, const std::string& where);
/// A depth image: uint16 in units of the camera, or float32 or float64 in metres; H x W. None: empty.
cv::Mat depth_image(const py::handle& array, const std::string& where);
/// A mask: bool or uint8, H x W; not 0 = dynamic. None: empty.
cv::Mat mask_image(const py::handle& array, const std::string& where);

/// A copy as H x W or H x W x 3 array; BGR becomes RGB. None for an empty image.
py::object array_of(const cv::Mat& image);
/// 4 x 4.
py::array_t<double> array_of(const Pose& pose);
/// N x 4 x 4.
py::array_t<double> array_of(const std::vector<Pose>& poses);

/// N x 2 [px].
py::array_t<float> pixels_of(const std::vector<Keypoint>& keypoints);

/// An N x `width` array of what lies behind each other in a vector.
template <typename T, typename Item>
py::array_t<T> rows_of(const std::vector<Item>& items, py::ssize_t width) {
  py::array_t<T> array({static_cast<py::ssize_t>(items.size()), width});
  if (!items.empty()) std::memcpy(array.mutable_data(), items.data(), items.size() * sizeof(Item));
  return array;
}

/// A pose of a 4 x 4 array. Throws Error naming `where` if it is none.
Pose pose_of(const py::handle& array, const std::string& where);

/// Seconds of a float, int, numpy.datetime64 or datetime. Throws Error naming `where` for what cannot be
/// meant as seconds: nanoseconds as an int, bool, text.
double seconds_of(const py::handle& time, const std::string& where);

}  // namespace stdc::python
