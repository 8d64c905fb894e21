#include "input/layouts/scannet/scannet_cameras.hpp"

#include "core/error.hpp"
#include "input/layouts/number_file.hpp"

namespace stdc {
namespace {

Camera camera_of(const Eigen::Matrix4d& intrinsic, cv::Size size, double units, const std::string& where) {
  Camera camera;
  camera.width = size.width, camera.height = size.height;
  camera.fx = intrinsic(0, 0), camera.fy = intrinsic(1, 1);
  camera.cx = intrinsic(0, 2), camera.cy = intrinsic(1, 2);
  camera.depth_units_per_metre = units;
  camera.validate(where);
  return camera;
}

Pose pose_of(const Eigen::Matrix4d& extrinsic, const std::string& where) {
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = extrinsic;
  const auto pose = pose_of_matrix(rows.data());
  if (!pose)
    throw Error(where, "an extrinsic matrix is no rigid transform", "put a camera.yaml into the folder");
  return *pose;
}

}  // namespace

RgbdCameras scannet_cameras(const ScanNetCalibration& c, const std::string& where) {
  RgbdCameras cameras;
  cameras.colour = camera_of(c.colour_intrinsic, c.colour_size, c.depth_units_per_metre, where);
  DepthCamera depth;
  depth.camera = camera_of(c.depth_intrinsic, c.depth_size, c.depth_units_per_metre, where);
  // Both are given against the same device; in all published scans both are the identity.
  depth.colour_from_depth = pose_of(c.colour_extrinsic, where).inverse() * pose_of(c.depth_extrinsic, where);
  const bool registered = depth.camera == cameras.colour && depth.colour_from_depth.log().norm() < 1e-9;
  if (!registered) cameras.depth = depth;
  return cameras;
}

}  // namespace stdc
