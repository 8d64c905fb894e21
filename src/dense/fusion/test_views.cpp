#include "dense/fusion/test_views.hpp"

#include <cmath>

#include "dense/fusion/rectifier.hpp"
#include "dense/fusion/view_codec.hpp"

namespace stdc::test {

Camera dense_camera() {
  Camera camera;
  camera.width = 160, camera.height = 120;
  camera.fx = camera.fy = 130, camera.cx = 79.5, camera.cy = 59.5;
  return camera;
}

std::shared_ptr<const DenseView> view_of(const std::function<float(float, float)>& depth, int frames) {
  const Pinhole pinhole = pinhole_of(dense_camera());
  FusedDepth fused{cv::Mat(pinhole.height, pinhole.width, CV_32FC1),
                   cv::Mat(pinhole.height, pinhole.width, CV_8UC1)};
  for (int y = 0; y < pinhole.height; ++y) {
    for (int x = 0; x < pinhole.width; ++x) {
      const float z = depth(pinhole.ray_x(static_cast<float>(x)), pinhole.ray_y(static_cast<float>(y)));
      fused.depth.at<float>(y, x) = z;
      fused.support.at<std::uint8_t>(y, x) =
          z > 0 ? static_cast<std::uint8_t>(FusedDepth::kDirect | static_cast<unsigned>(frames)) : 0;
    }
  }
  auto view = std::make_shared<DenseView>();
  encode_view(fused, 100, cv::Mat(pinhole.height, pinhole.width, CV_8UC3, cv::Scalar(200, 120, 100)), *view);
  return view;
}

PlacedView ball_and_wall(const Eigen::Vector3d& camera, bool with_ball) {
  constexpr float kRadius = 0.3F, kWall = 2.5F;
  const Eigen::Vector3f centre = (Eigen::Vector3d(0, 0, 1.5) - camera).cast<float>();
  const auto depth = [&](float x, float y) {
    const Eigen::Vector3f ray(x, y, 1);
    // |s ray - centre| = radius
    const float a = ray.squaredNorm(), b = ray.dot(centre), c = centre.squaredNorm() - kRadius * kRadius;
    const float root = b * b - a * c;
    if (with_ball && root > 0) return (b - std::sqrt(root)) / a;
    return kWall - static_cast<float>(camera.z());
  };
  return {view_of(depth), Pose(Eigen::Quaterniond::Identity(), -camera)};
}

PlacedView moving_ball() {
  const PlacedView still = ball_and_wall(Eigen::Vector3d::Zero());
  FusedDepth fused = decode_depth(*still.view, {dense_camera().width, dense_camera().height});
  fused.depth.setTo(0, fused.depth > 2);
  fused.support.setTo(FusedDepth::kMoving);
  auto view = std::make_shared<DenseView>(*still.view);
  encode_view(fused, 100, cv::Mat(fused.depth.size(), CV_8UC3, cv::Scalar::all(0)), *view);
  return {view, Pose()};
}

DenseSettings coarse_settings() {
  DenseSettings settings;
  settings.voxel = 0.02;
  return settings;
}

}  // namespace stdc::test
