#include "input/tum_calibration.hpp"

namespace stdc {

std::optional<Camera> tum_calibration(std::string_view folder_name) {
  // Freiburg 1 and 2 were taken with a Kinect, whose colour camera has a rolling shutter (Ringaby and
  // Forssen, ICCV 2011). The time was found from images alone: with it most landmarks are where they are
  // expected. The Xtion of freiburg 3 has not been measured yet.
  constexpr double kKinectReadout = 0.026;  // [s]
  Camera camera;
  const auto named = [&](std::string_view word) { return folder_name.find(word) != std::string_view::npos; };
  const auto pinhole = [&](double fx, double fy, double cx, double cy) {
    camera.fx = fx, camera.fy = fy, camera.cx = cx, camera.cy = cy;
  };
  const auto lens = [&](double k1, double k2, double p1, double p2, double k3) {
    camera.k1 = k1, camera.k2 = k2, camera.p1 = p1, camera.p2 = p2, camera.k3 = k3;
  };
  if (named("freiburg1")) {
    pinhole(517.306408, 516.469215, 318.643040, 255.313989);
    lens(0.262383, -0.953104, -0.005358, 0.002628, 1.163314);
    camera.readout_time = kKinectReadout;
  } else if (named("freiburg2")) {
    pinhole(520.908620, 521.007327, 325.141442, 249.701764);
    lens(0.231222, -0.784899, -0.003257, -0.000105, 0.917205);
    camera.readout_time = kKinectReadout;
  } else if (named("freiburg3")) {
    pinhole(535.433105, 539.212524, 320.106653, 247.632132);
  } else if (named("rgbd_bonn")) {
    pinhole(542.822841, 542.576870, 315.593520, 237.756098);
    lens(0.039903, -0.099343, -0.000730, -0.000144, 0);
  } else {
    return std::nullopt;
  }
  return camera;
}

}  // namespace stdc
