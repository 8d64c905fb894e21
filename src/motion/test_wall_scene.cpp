#include "motion/test_wall_scene.hpp"

#include <cmath>
#include <opencv2/core.hpp>

namespace stdc::test {
namespace {

/// A number from 0 to 255 for each square of a lattice.
int lattice(unsigned seed, long x, long y) {
  auto h = static_cast<unsigned>(x * 73856093L) ^ static_cast<unsigned>(y * 19349663L) ^ (seed * 83492791U);
  h = (h ^ (h >> 13U)) * 1274126177U;
  return static_cast<int>((h ^ (h >> 16U)) & 255U);
}

/// Squares of 4 cm, softened.
double texture(unsigned seed, double x, double y) {
  constexpr double kSide = 0.04;
  const double u = x / kSide, v = y / kSide;
  const double fu = std::floor(u), fv = std::floor(v);
  const auto i = static_cast<long>(fu), j = static_cast<long>(fv);
  const double a = u - fu, b = v - fv;
  return (1 - b) * ((1 - a) * lattice(seed, i, j) + a * lattice(seed, i + 1, j)) +
         b * ((1 - a) * lattice(seed, i, j + 1) + a * lattice(seed, i + 1, j + 1));
}

constexpr double kWall = 3;

/// Index of the panel that a ray from `centre` hits first, or -1.
int hit(const std::vector<Panel>& panels, const Eigen::Vector3d& centre, double x, double y) {
  int best = -1;
  double nearest = kWall;
  for (int i = 0; i < static_cast<int>(panels.size()); ++i) {
    const Panel& panel = panels[static_cast<std::size_t>(i)];
    const double z = panel.z - centre.z();
    if (z <= 0 || panel.z >= nearest) continue;
    const double px = centre.x() + x * z, py = centre.y() + y * z;
    if (px < panel.left || px > panel.right || py < panel.top || py > panel.bottom) continue;
    nearest = panel.z;
    best = i;
  }
  return best;
}

}  // namespace

WallScene::WallScene() {
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 260;
  camera.cx = 159.5;
  camera.cy = 119.5;
}

void WallScene::draw(const Eigen::Vector3d& centre, cv::Mat& grey, cv::Mat& depth) const {
  grey.create(camera.height, camera.width, CV_8UC1);
  depth.create(camera.height, camera.width, CV_16UC1);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double x = (u - camera.cx) / camera.fx, y = (v - camera.cy) / camera.fy;
      const int index = hit(panels, centre, x, y);
      const double world_z = index < 0 ? kWall : panels[static_cast<std::size_t>(index)].z;
      const double z = world_z - centre.z();
      const unsigned seed = index < 0 ? 99 : panels[static_cast<std::size_t>(index)].seed;
      const double slide = index < 0 ? 0 : panels[static_cast<std::size_t>(index)].slide;
      grey.at<std::uint8_t>(v, u) =
          static_cast<std::uint8_t>(texture(seed, centre.x() + x * z - slide, centre.y() + y * z));
      depth.at<std::uint16_t>(v, u) =
          static_cast<std::uint16_t>(std::lround(z * camera.depth_units_per_metre));
    }
  }
}

cv::Mat WallScene::panel_mask(const Eigen::Vector3d& centre) const {
  cv::Mat mask(camera.height, camera.width, CV_8UC1, cv::Scalar(0));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (hit(panels, centre, (u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy) >= 0) {
        mask.at<std::uint8_t>(v, u) = 255;
      }
    }
  }
  return mask;
}

void WallRun::see(const Eigen::Vector3d& centre, const cv::Mat& hole) {
  MotionFrame input;
  input.number = frame;
  input.timestamp = frame / 30.0;
  scene.draw(centre, input.grey, input.depth);
  if (!hole.empty()) input.depth.setTo(0, hole);
  input.motion = CameraMotion(scene.camera, Vector6d::Zero());
  input.cam_from_world = Pose(Eigen::Quaterniond::Identity(), -centre);
  input.segmented = segmented;
  input.trusted = true;
  input.reference = {0};
  input.frame_from_reference = *input.cam_from_world;
  input.map = {0};
  SmallFrame small;
  shrink_frame(input.grey, input.depth, scene.camera.depth_units_per_metre, small);
  const std::vector<LandmarkId> now = detector.observe(input, small, {});
  gone.insert(gone.end(), now.begin(), now.end());
  ++frame;
}

}  // namespace stdc::test
