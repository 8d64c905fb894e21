#include "input/recordings/messages/camera_of_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "core/lower_case.hpp"

namespace stdc {
namespace {

constexpr const char* kCameraHint = "give a camera file with --camera";

enum class Lens { none, plumb_bob, rational, equidistant, unknown };

Lens lens_of(std::string_view model) {
  std::string name = lower_case(std::string(model));
  std::replace(name.begin(), name.end(), ' ', '_');
  if (name.empty() || name == "none") return Lens::none;
  if (name == "plumb_bob" || name == "brown_conrady") return Lens::plumb_bob;
  if (name == "rational_polynomial") return Lens::rational;
  if (name == "equidistant" || name == "fisheye" || name == "kannala_brandt4") return Lens::equidistant;
  return Lens::unknown;
}

/// How many coefficients a lens may have here.
std::size_t coefficients_of(Lens lens) {
  switch (lens) {
    case Lens::plumb_bob:
      return 5;
    case Lens::rational:
      return 8;
    case Lens::equidistant:
      return 4;
    default:
      return 0;
  }
}

bool all_zero(const std::vector<double>& values, std::size_t from = 0) {
  return values.size() <= from || std::all_of(values.begin() + static_cast<std::ptrdiff_t>(from),
                                              values.end(), [](double value) { return value == 0; });
}

void set_lens(const CameraInfoMessage& info, Camera& camera, const std::string& where) {
  const Lens lens = lens_of(info.distortion_model);
  if (lens != Lens::equidistant && all_zero(info.d)) return;
  if (lens == Lens::unknown || lens == Lens::none) {
    throw Error(where, fmt::format("its lens model {} is not known", shown(info.distortion_model)),
                kCameraHint);
  }
  const std::size_t count = coefficients_of(lens);
  if (!all_zero(info.d, count)) {
    throw Error(where,
                fmt::format("its lens {} has {} coefficients, but only {} are known here",
                            shown(info.distortion_model), info.d.size(), count),
                kCameraHint);
  }
  std::vector<double> d = info.d;
  d.resize(8, 0.0);
  if (lens == Lens::equidistant) {
    camera.lens = LensModel::equidistant;
    camera.k1 = d[0], camera.k2 = d[1], camera.k3 = d[2], camera.k4 = d[3];
    return;
  }
  camera.k1 = d[0], camera.k2 = d[1], camera.p1 = d[2], camera.p2 = d[3], camera.k3 = d[4];
  camera.k4 = d[5], camera.k5 = d[6], camera.k6 = d[7];
}

}  // namespace

Camera camera_of_info(const CameraInfoMessage& info, bool rectified, const std::string& where) {
  constexpr std::uint32_t kMaxCameraSide = 16384;
  if (info.width < 1 || info.height < 1 || info.width > kMaxCameraSide || info.height > kMaxCameraSide) {
    throw Error(where, fmt::format("gives a size of {} x {} pixels", info.width, info.height), kCameraHint);
  }
  Camera camera;
  const auto& m = info.k;
  if (rectified && info.p[0] > 0) {
    camera.fx = info.p[0], camera.fy = info.p[5], camera.cx = info.p[2], camera.cy = info.p[6];
  } else {
    camera.fx = m[0], camera.fy = m[4], camera.cx = m[2], camera.cy = m[5];
  }
  if (!(camera.fx > 0 && camera.fy > 0))
    throw Error(where, "the camera was not calibrated: its focal length is 0", kCameraHint);
  if (!rectified) set_lens(info, camera, where);
  // K and P are those of the whole sensor without binning; a pixel's middle lies at a whole number.
  const bool has_region = info.roi_width > 0 && info.roi_height > 0;
  if (has_region && (std::uint64_t{info.roi_x} + info.roi_width > info.width ||
                     std::uint64_t{info.roi_y} + info.roi_height > info.height)) {
    throw Error(where, "its region of interest lies outside the image", kCameraHint);
  }
  if (has_region) camera.cx -= info.roi_x, camera.cy -= info.roi_y;
  const double binning_x = std::max(info.binning_x, 1U), binning_y = std::max(info.binning_y, 1U);
  camera.fx /= binning_x, camera.fy /= binning_y;
  camera.cx = (camera.cx + 0.5) / binning_x - 0.5, camera.cy = (camera.cy + 0.5) / binning_y - 0.5;
  camera.width = static_cast<int>((has_region ? info.roi_width : info.width) / binning_x);
  camera.height = static_cast<int>((has_region ? info.roi_height : info.height) / binning_y);
  camera.validate(where);
  return camera;
}

}  // namespace stdc
