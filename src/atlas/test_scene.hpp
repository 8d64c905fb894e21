#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "atlas/atlas.hpp"
#include "atlas/test_consistency.hpp"
#include "core/random.hpp"
#include "features/feature_settings.hpp"

namespace stdc {
class Pyramid;
}

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
  int keypoint_of(int point) const;
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

Descriptor random_descriptor(Random& random);

FeatureSettings scene_feature_settings();

/// A pose that looks along z: position [m], then a rotation vector [rad].
Pose camera_at(double x, double y, double z, double pitch = 0, double yaw = 0, double roll = 0);

/// Distance between the centres [m] and angle between the axes [rad] of two cameras.
double centre_error(const Pose& a, const Pose& b);
double angle_error(const Pose& a, const Pose& b);

class Scene {
 public:
  Camera camera;
  std::vector<ScenePoint> points;

  /// Points on a wall 3 m ahead of the origin and, unless `wall_only`, on the floor and a wall at the left.
  explicit Scene(int count, bool wall_only = false, std::uint64_t seed = 1);

  /// Projects all points; those that would lie on top of another or too near to the border are not seen.
  View look(const Pose& cam_from_world, const ViewOptions& options = {}) const;

  /// The image of the room's surfaces, which all have a fine random pattern.
  cv::Mat render(const Pose& cam_from_world) const;

 private:
  static constexpr double kWall = 3, kLeft = -1.2, kRight = 3.2, kFloor = 0.8;  // [m]

  bool see(const ScenePoint& point, const View& view, const ViewOptions& options, Random& random,
           Keypoint& keypoint, double& z) const;

  /// Nearer than this the depths around one point would be those of another.
  static bool crowded(const std::vector<Keypoint>& others, const Keypoint& keypoint);

  /// Waves of a hand's breadth and shorter in many directions: smooth, and nowhere like itself.
  static std::uint8_t shade(const Eigen::Vector3d& p);
};

/// A scene and a map of it, made without any error.
struct MappedScene {
  Scene scene;
  Atlas atlas;
  std::vector<View> views;            ///< per keyframe
  std::vector<LandmarkId> landmarks;  ///< per point of the scene; invalid: not mapped
  MapId map{0};                       ///< to which keyframes are added

  explicit MappedScene(const Scene& room);

  /// A keyframe that sees no landmark yet.
  KeyframeId add_bare(const View& view);

  /// From now on keyframes are added to another map, which knows nothing of those before.
  void start_map();

  /// A keyframe that sees the landmarks of all its points; those not in the map yet are put into it.
  KeyframeId add(const View& view);
};

}  // namespace stdc::test
