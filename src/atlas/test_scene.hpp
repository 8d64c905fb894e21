#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "atlas/atlas.hpp"
#include "atlas/test_consistency.hpp"
#include "core/random.hpp"
#include "features/detection/pyramid.hpp"
#include "features/feature_settings.hpp"

/// A corner of a room with known points, for the tests of map, tracking and mapping: what a camera anywhere
/// in it sees is known, the descriptors, levels and depths of all keypoints included.
namespace stdc::test {

/// A point of the room that gives a keypoint in every image that shows it.
struct ScenePoint {
  Eigen::Vector3d position;  ///< world [m]
  Descriptor descriptor;
  float angle = 0;        ///< [rad]
  double size_level = 0;  ///< pyramid level at which it is seen from 3 m, as a real number
};

/// What one camera sees.
struct View {
  Pose cam_from_world;
  CameraMotion motion;
  std::shared_ptr<const FrameFeatures> features;
  std::vector<int> points;  ///< per keypoint: the scene's point that it sees

  /// Keypoint that sees a point, or -1.
  int keypoint_of(int point) const {
    const auto place = std::find(points.begin(), points.end(), point);
    return place == points.end() ? -1 : static_cast<int>(place - points.begin());
  }
};

struct ViewOptions {
  bool depth = true;
  double depth_noise = 0;     ///< sigma of the inverse depth [1/m]
  double pixel_noise = 0;     ///< sigma on level 0 [px]
  int flipped_bits = 6;       ///< of each descriptor
  bool whole_pixels = false;  ///< keypoints lie on whole pixels of their level, as those of an extractor do
  const Pyramid* pyramid = nullptr;   ///< to cut patches from
  Vector6d twist = Vector6d::Zero();  ///< of the camera, per second; matters with a rolling shutter
  std::uint64_t seed = 1;
};

inline Descriptor random_descriptor(Random& random) {
  Descriptor descriptor;
  for (auto& word : descriptor.bits) word = (std::uint64_t{random.next()} << 32U) | random.next();
  return descriptor;
}

inline FeatureSettings scene_feature_settings() {
  FeatureSettings settings;
  settings.levels = 6;
  settings.scale_factor = 1.2;
  return settings;
}

/// A pose that looks along z: position [m], then a rotation vector [rad].
inline Pose camera_at(double x, double y, double z, double pitch = 0, double yaw = 0, double roll = 0) {
  const Eigen::Quaterniond rotation = rotation_exp({pitch, yaw, roll});
  return Pose(rotation, -(rotation * Eigen::Vector3d(x, y, z)));
}

/// Distance between the centres [m] and angle between the axes [rad] of two cameras.
inline double centre_error(const Pose& a, const Pose& b) { return (a.centre() - b.centre()).norm(); }
inline double angle_error(const Pose& a, const Pose& b) { return a.rotation.angularDistance(b.rotation); }

class Scene {
 public:
  Camera camera;
  std::vector<ScenePoint> points;

  /// Points on a wall 3 m ahead of the origin and, unless `wall_only`, on the floor and a wall at the left.
  explicit Scene(int count, bool wall_only = false, std::uint64_t seed = 1) {
    Random random(seed);
    for (int i = 0; i < count; ++i) {
      ScenePoint point;
      const double x = random.uniform(kLeft, kRight), y = random.uniform(-1.3, kFloor),
                   z = random.uniform(1.7, kWall);
      const std::uint32_t surface = wall_only ? 0 : random.below(4);
      point.position = {surface == 2 ? kLeft : x, surface == 3 ? kFloor : y, surface < 2 ? kWall : z};
      point.descriptor = random_descriptor(random);
      point.angle = static_cast<float>(random.uniform(-3.1, 3.1));
      point.size_level = random.uniform(0.0, 4.0);
      points.push_back(point);
    }
  }

  /// Projects all points; those that would lie on top of another or too near to the border are not seen.
  View look(const Pose& cam_from_world, const ViewOptions& options = {}) const {
    View view{cam_from_world, CameraMotion(camera, options.twist), nullptr, {}};
    Random random(options.seed);
    Features raw;
    cv::Mat depth(camera.height, camera.width, CV_32FC1, cv::Scalar(0));
    for (int p = 0; p < static_cast<int>(points.size()); ++p) {
      Keypoint keypoint;
      double z = 0;
      if (!see(points[p], view, options, random, keypoint, z) || crowded(raw.keypoints, keypoint)) continue;
      Descriptor descriptor = points[p].descriptor;
      for (int n = 0; n < options.flipped_bits; ++n)
        descriptor.bits[random.below(4)] ^= std::uint64_t{1} << random.below(64);
      z = 1 / (1 / z + options.depth_noise * random.normal());
      depth.at<float>(static_cast<int>(std::lround(keypoint.y)), static_cast<int>(std::lround(keypoint.x))) =
          static_cast<float>(z);
      raw.keypoints.push_back(keypoint);
      raw.descriptors.push_back(descriptor);
      view.points.push_back(p);
    }
    const FeatureSettings pyramid = scene_feature_settings();
    view.features = std::make_shared<FrameFeatures>(camera, std::move(raw), options.depth ? depth : cv::Mat(),
                                                    pyramid.scale_factor, pyramid.levels, options.pyramid);
    return view;
  }

  /// The image of the room's surfaces, which all have a fine random pattern.
  cv::Mat render(const Pose& cam_from_world) const {
    cv::Mat image(camera.height, camera.width, CV_8UC1);
    const Eigen::Vector3d centre = cam_from_world.centre();
    const Eigen::Matrix3d world_from_cam = cam_from_world.rotation_matrix().transpose();
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d ray = world_from_cam * camera.unproject(Eigen::Vector2d(u, v), 1);
        const double to_wall = (kWall - centre.z()) / ray.z();
        const double to_left = ray.x() < 0 ? (kLeft - centre.x()) / ray.x() : 1e9;
        const double to_floor = ray.y() > 0 ? (kFloor - centre.y()) / ray.y() : 1e9;
        image.at<std::uint8_t>(v, u) = shade(centre + std::min({to_wall, to_left, to_floor}) * ray);
      }
    }
    return image;
  }

 private:
  static constexpr double kWall = 3, kLeft = -1.2, kRight = 3.2, kFloor = 0.8;  // [m]

  bool see(const ScenePoint& point, const View& view, const ViewOptions& options, Random& random,
           Keypoint& keypoint, double& z) const {
    const FeatureSettings pyramid = scene_feature_settings();
    const double dx = random.normal(), dy = random.normal();
    const Eigen::Vector3d at_middle = view.cam_from_world * point.position;
    if (!(at_middle.z() > 0.3)) return false;
    const double level = point.size_level + std::log(3 / at_middle.norm()) / std::log(pyramid.scale_factor);
    keypoint.level = static_cast<std::uint8_t>(std::clamp<long>(std::lround(level), 0, pyramid.levels - 1));
    const double scale = std::pow(pyramid.scale_factor, keypoint.level);
    const Eigen::Vector2d ideal = view.motion.project(camera, at_middle);
    if (!(std::abs(ideal.x() - camera.cx) < camera.width && std::abs(ideal.y() - camera.cy) < camera.height))
      return false;
    z = view.motion.later(at_middle, view.motion.row_time(ideal.y())).z();
    Eigen::Vector2d raw = camera.distort(ideal) + options.pixel_noise * scale * Eigen::Vector2d(dx, dy);
    if (options.whole_pixels) {
      for (double& x : raw) x = (std::round((x + 0.5) / scale - 0.5) + 0.5) * scale - 0.5;
    }
    const double border = (kBorder + 1) * scale;
    keypoint.x = static_cast<float>(raw.x());
    keypoint.y = static_cast<float>(raw.y());
    keypoint.angle = point.angle;
    keypoint.quality = KeypointQuality::high;
    return raw.x() > border && raw.y() > border && raw.x() < camera.width - border &&
           raw.y() < camera.height - border;
  }

  /// Nearer than this the depths around one point would be those of another.
  static bool crowded(const std::vector<Keypoint>& others, const Keypoint& keypoint) {
    return std::any_of(others.begin(), others.end(), [&](const Keypoint& other) {
      return std::abs(other.x - keypoint.x) < 6 && std::abs(other.y - keypoint.y) < 6;
    });
  }

  /// Waves of a hand's breadth and shorter in many directions: smooth, and nowhere like itself.
  static std::uint8_t shade(const Eigen::Vector3d& p) {
    const double a = p.x() + 0.7 * p.z(), b = p.y() - 0.6 * p.z();
    const double sum = std::sin(61 * a + 9 * b) + std::sin(-37 * a + 53 * b + 1) +
                       std::sin(97 * b - 19 * a + 2) + std::sin(83 * a + 71 * b + 3) +
                       std::sin(113 * a - 29 * b + 4);
    return static_cast<std::uint8_t>(128 + 22 * sum);
  }
};

/// A scene and a map of it, made without any error.
struct MappedScene {
  Scene scene;
  Atlas atlas;
  std::vector<View> views;            ///< per keyframe
  std::vector<LandmarkId> landmarks;  ///< per point of the scene; invalid: not mapped
  MapId map{0};                       ///< to which keyframes are added

  explicit MappedScene(const Scene& room) : scene(room), landmarks(room.points.size()) {}

  /// A keyframe that sees no landmark yet.
  KeyframeId add_bare(const View& view) {
    views.push_back(view);
    const int frame = 10 * static_cast<int>(views.size() - 1);
    return atlas.add_keyframe({frame, frame / 30.0, view.cam_from_world, view.motion, view.features,
                               measure_keypoints(scene.camera, view.motion, *view.features), map});
  }

  /// From now on keyframes are added to another map, which knows nothing of those before.
  void start_map() {
    map = atlas.next_map();
    landmarks.assign(landmarks.size(), {});
  }

  /// A keyframe that sees the landmarks of all its points; those not in the map yet are put into it.
  KeyframeId add(const View& view) {
    const KeyframeId id = add_bare(view);
    for (int i = 0; i < view.features->size(); ++i) {
      LandmarkId& landmark = landmarks[view.points[i]];
      if (!landmark.valid()) landmark = atlas.add_landmark(scene.points[view.points[i]].position, id);
      atlas.observe(id, i, landmark);
      atlas.refresh(landmark);
    }
    atlas.update_covisibility(id);
    return id;
  }
};

}  // namespace stdc::test
