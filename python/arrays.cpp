#include "arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"

namespace stdc::python {
namespace {

py::array array_in(const py::handle& object, const std::string& where, const char* hint) {
  if (!py::isinstance<py::array>(object)) {
    throw Error(where, fmt::format("is no numpy array but {}", std::string(py::str(py::type::of(object)))),
                hint);
  }
  return py::reinterpret_borrow<py::array>(object);
}

std::string shape_text(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    text += (i > 0 ? " x " : "") + std::to_string(array.shape(i));
  return text.empty() ? "no size" : text;
}

[[noreturn]] void refuse(const py::array& array, const std::string& where, const char* hint) {
  throw Error(where, fmt::format("is {} of {}", shape_text(array), std::string(py::str(array.dtype()))),
              hint);
}

bool is_kind(const py::array& array, char kind, py::ssize_t bytes) {
  return array.dtype().kind() == kind && array.itemsize() == bytes;
}

/// The values in one piece, whatever strides and byte order they have.
template <typename T>
py::array_t<T, py::array::c_style | py::array::forcecast> packed(const py::array& array) {
  return py::array_t<T, py::array::c_style | py::array::forcecast>(array);
}

constexpr int kAsTheyAre = -1;

/// The values, of `type`, as an image, converted by a code of cv::cvtColor. It has the array's own memory
/// where nothing is to be changed: what is called with it keeps no image that it was not given
/// (RgbdImage::may_be_kept).
template <typename T>
cv::Mat image_of(const py::array& array, int type, int code = kAsTheyAre) {
  const auto values = packed<T>(array);
  const cv::Mat shared(static_cast<int>(array.shape(0)), static_cast<int>(array.shape(1)), type,
                       const_cast<T*>(values.data()));
  if (code == kAsTheyAre) return values.ptr() == array.ptr() ? shared : shared.clone();
  // By bands that are too small for OpenCV to share with other threads, for which it would have to wait.
  constexpr int kMaxBand = 1 << 16;
  const int rows = std::max(1, kMaxBand / shared.cols - 1);
  const bool to_grey = code == cv::COLOR_RGB2GRAY || code == cv::COLOR_BGR2GRAY;
  cv::Mat converted(shared.size(), to_grey ? CV_8UC1 : type);
  for (int top = 0; top < shared.rows; top += rows) {
    const cv::Range band(top, std::min(top + rows, shared.rows));
    cv::cvtColor(shared.rowRange(band), converted.rowRange(band), code);
  }
  return converted;
}

void check_size(const py::array& array, const std::string& where, const char* hint) {
  constexpr py::ssize_t kMaxSide = 1 << 15;
  for (py::ssize_t i = 0; i < 2; ++i) {
    if (array.shape(i) < 1 || array.shape(i) > kMaxSide) refuse(array, where, hint);
  }
}

py::array colour_array(const py::handle& object, const std::string& order, const std::string& where) {
  constexpr const char* kHint = "give uint8, height x width x 3 or height x width";
  if (order != "rgb" && order != "bgr")
    throw Error("order", "'" + order + "' is none", "say \"rgb\" or \"bgr\"");
  py::array array = array_in(object, where, kHint);
  const bool grey = array.ndim() == 2;
  if (!is_kind(array, 'u', 1) || !(grey || (array.ndim() == 3 && array.shape(2) == 3)))
    refuse(array, where, kHint);
  check_size(array, where, kHint);
  return array;
}

}  // namespace

cv::Mat colour_image(const py::handle& object, const std::string& order, const std::string& where) {
  const py::array array = colour_array(object, order, where);
  if (array.ndim() == 2) return image_of<std::uint8_t>(array, CV_8UC1);
  return image_of<std::uint8_t>(array, CV_8UC3, order == "rgb" ? cv::COLOR_RGB2BGR : kAsTheyAre);
}

cv::Mat grey_image(const py::handle& object, const std::string& order, const std::string& where) {
  const py::array array = colour_array(object, order, where);
  if (array.ndim() == 2) return image_of<std::uint8_t>(array, CV_8UC1);
  return image_of<std::uint8_t>(array, CV_8UC3, order == "rgb" ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
}

cv::Mat depth_image(const py::handle& object, const std::string& where) {
  constexpr const char* kHint =
      "give height x width: uint16 in the camera's units, or float32 in metres, registered to the colour "
      "image";
  if (object.is_none()) return {};
  const py::array array = array_in(object, where, kHint);
  const bool whole = is_kind(array, 'u', 2), real = is_kind(array, 'f', 4) || is_kind(array, 'f', 8);
  if (array.ndim() != 2 || !(whole || real)) refuse(array, where, kHint);
  check_size(array, where, kHint);
  return whole ? image_of<std::uint16_t>(array, CV_16UC1) : image_of<float>(array, CV_32FC1);
}

cv::Mat mask_image(const py::handle& object, const std::string& where) {
  constexpr const char* kHint = "give bool or uint8, height x width";
  if (object.is_none()) return {};
  const py::array array = array_in(object, where, kHint);
  if (array.ndim() != 2 || !(is_kind(array, 'u', 1) || is_kind(array, 'b', 1))) refuse(array, where, kHint);
  check_size(array, where, kHint);
  return image_of<std::uint8_t>(array, CV_8UC1);
}

py::object array_of(const cv::Mat& image) {
  if (image.empty()) return py::none();
  const py::ssize_t rows = image.rows, columns = image.cols;
  const auto copy = [&](py::array array, const cv::Mat& from) {
    cv::Mat to(from.size(), from.type(), array.mutable_data());
    from.copyTo(to);
    return array;
  };
  switch (image.type()) {
    case CV_8UC1:
      return copy(py::array_t<std::uint8_t>({rows, columns}), image);
    case CV_16UC1:
      return copy(py::array_t<std::uint16_t>({rows, columns}), image);
    case CV_32FC1:
      return copy(py::array_t<float>({rows, columns}), image);
    default: {
      cv::Mat rgb;
      cv::cvtColor(image, rgb, cv::COLOR_BGR2RGB);
      return copy(py::array_t<std::uint8_t>({rows, columns, py::ssize_t{3}}), rgb);
    }
  }
}

py::array_t<double> array_of(const std::vector<Pose>& poses) {
  py::array_t<double> array({static_cast<py::ssize_t>(poses.size()), py::ssize_t{4}, py::ssize_t{4}});
  auto to = array.mutable_unchecked<3>();
  for (py::ssize_t n = 0; n < array.shape(0); ++n) {
    const Pose& pose = poses[static_cast<std::size_t>(n)];
    const Eigen::Matrix3d rotation = pose.rotation_matrix();
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        to(n, row, column) = row == 3      ? (column == 3 ? 1.0 : 0.0)
                             : column == 3 ? pose.translation[row]
                                           : rotation(row, column);
      }
    }
  }
  return array;
}

py::array_t<double> array_of(const Pose& pose) {
  py::array_t<double> array = array_of(std::vector<Pose>{pose});
  return array.reshape({4, 4});
}

py::array_t<float> pixels_of(const std::vector<Keypoint>& keypoints) {
  py::array_t<float> array({static_cast<py::ssize_t>(keypoints.size()), py::ssize_t{2}});
  auto to = array.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    to(i, 0) = keypoints[static_cast<std::size_t>(i)].x;
    to(i, 1) = keypoints[static_cast<std::size_t>(i)].y;
  }
  return array;
}

Pose pose_of(const py::handle& object, const std::string& where) {
  constexpr const char* kHint = "give 4 x 4: a rotation matrix, a translation [m], and 0 0 0 1 below";
  const py::array array = array_in(object, where, kHint);
  if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4) refuse(array, where, kHint);
  const auto values = packed<double>(array);
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(values.data());
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  constexpr double kTolerance = 1e-3;
  if (!matrix.allFinite() || !(rotation * rotation.transpose()).isIdentity(kTolerance) ||
      rotation.determinant() < 0 || !matrix.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), kTolerance)) {
    throw Error(where, "is no rigid transform", kHint);
  }
  return {rotation, matrix.topRightCorner<3, 1>()};
}

double seconds_of(const py::handle& time, const std::string& where) {
  constexpr const char* kHint = "give seconds as a float, a numpy.datetime64 or a datetime";
  constexpr double kFarAhead = 1e11;  // the year 5138; less than any clock of this century in milliseconds
  if (py::isinstance<py::bool_>(time) || py::isinstance<py::str>(time))
    throw Error(where, "is no time", kHint);
  if (py::hasattr(time, "astype") && py::hasattr(time, "dtype") &&
      std::string(py::str(time.attr("dtype").attr("kind"))) == "M") {
    const auto nanoseconds =
        time.attr("astype")("datetime64[ns]").attr("astype")("int64").cast<std::int64_t>();
    if (nanoseconds == std::numeric_limits<std::int64_t>::min())
      throw Error(where, "is not a time (NaT)", kHint);
    return 1e-9 * static_cast<double>(nanoseconds);
  }
  if (py::hasattr(time, "timestamp")) return time.attr("timestamp")().cast<double>();
  const double seconds = PyFloat_AsDouble(time.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw Error(where, fmt::format("is no time but {}", std::string(py::str(py::type::of(time)))), kHint);
  }
  if (std::isfinite(seconds) && std::abs(seconds) > kFarAhead) {
    throw Error(where, fmt::format("{} are no seconds of this age", seconds),
                "divide nanoseconds by 1e9, milliseconds by 1e3");
  }
  return seconds;
}

}  // namespace stdc::python
