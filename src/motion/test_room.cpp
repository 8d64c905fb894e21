#include "motion/test_room.hpp"

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "segmentation/propagation/test_stage.hpp"

namespace stdc::test {
namespace {

constexpr double kWall = 3.5, kFloor = 0.9, kUnitsPerMetre = 5000;  // [m]; of depth
constexpr double kTexel = 0.004;                                    // [m]

struct Hit {
  double depth = std::numeric_limits<double>::infinity();
  double u = 0, v = 0;  ///< on the surface [m]
  bool box = false;
};

/// The front of a box that faces the wall's way.
void hit_front(const Eigen::Vector3d& from, const Eigen::Vector3d& ray, const Eigen::Vector3d& middle,
               const Eigen::Vector2d& size, double offset, bool is_box, Hit& hit) {
  const double depth = (middle.z() - from.z()) / ray.z();
  if (!(depth > 0.1) || depth >= hit.depth) return;
  const Eigen::Vector3d at = from + depth * ray - middle;
  if (std::abs(at.x()) > 0.5 * size.x() || std::abs(at.y()) > 0.5 * size.y()) return;
  hit = {depth, at.x() + offset, at.y() + offset, is_box};
}

}  // namespace

Room::Room() : texture_(texture({2048, 2048}, 7)) {
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 262;
  camera.cx = 159.5;
  camera.cy = 119.5;
}

RoomShot Room::look(const Pose& cam_from_world, const std::optional<Eigen::Vector3d>& box) const {
  const cv::Size size(camera.width, camera.height);
  RoomShot shot{cv::Mat(size, CV_8UC1), cv::Mat(size, CV_16UC1), cv::Mat::zeros(size, CV_8UC1)};
  const Eigen::Vector3d from = cam_from_world.centre();
  const Eigen::Matrix3d world_from_cam = cam_from_world.rotation_matrix().transpose();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Eigen::Vector3d ray = world_from_cam * camera.unproject({x, y}, 1);
      Hit hit;
      hit_front(from, ray, {0, 0, kWall}, {40, 40}, 3, false, hit);
      const double floor = (kFloor - from.y()) / ray.y();
      if (floor > 0.1 && floor < hit.depth) {
        hit = {floor, from.x() + floor * ray.x() + 5, from.z() + floor * ray.z() + 5, false};
      }
      hit_front(from, ray, {-0.7, 0, 1.8}, {0.35, 3}, 1.3, false, hit);
      if (box) hit_front(from, ray, *box, {0.6, 0.9}, 2.1, true, hit);
      const int u = static_cast<int>(std::lround(hit.u / kTexel)) & 2047;
      const int v = static_cast<int>(std::lround(hit.v / kTexel)) & 2047;
      shot.grey.at<std::uint8_t>(y, x) = texture_.at<std::uint8_t>(v, u);
      shot.depth.at<std::uint16_t>(y, x) =
          static_cast<std::uint16_t>(std::min(hit.depth, 13.0) * kUnitsPerMetre);
      shot.mask.at<std::uint8_t>(y, x) = hit.box ? 255 : 0;
    }
  }
  return shot;
}

cv::Mat RoomWatch::show(const RoomShot& shot, const std::optional<Pose>& cam_from_world, bool is_keyframe,
                        const cv::Mat& segmented) {
  MotionFrame frame;
  frame.number = next_++;
  frame.timestamp = frame.number / 30.0;
  frame.grey = shot.grey;
  frame.depth = shot.depth;
  frame.cam_from_world = cam_from_world;
  frame.trusted = cam_from_world.has_value();
  frame.is_keyframe = is_keyframe;
  frame.segmented = segmented;
  frame.map = MapId{0};
  frame.reference = KeyframeId{0};
  propagator_.add_frame(frame.number, frame.grey, frame.depth);
  detector_.observe(frame, propagator_.newest(), propagator_.tiles());
  const cv::Mat mask = detector_.mask();
  propagator_.set_mask(frame.number, mask);
  return mask;
}

double share(const cv::Mat& mask) {
  return static_cast<double>(cv::countNonZero(mask)) / static_cast<double>(mask.total());
}

double overlap(const cv::Mat& mask, const cv::Mat& truth) {
  const cv::Mat both = mask & truth, any = mask | truth;
  return static_cast<double>(cv::countNonZero(both)) / std::max(1, cv::countNonZero(any));
}

}  // namespace stdc::test
