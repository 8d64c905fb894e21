#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/random.hpp"
#include "estimation/bundle_adjustment.hpp"
#include "estimation/pose_optimisation.hpp"

/// Problems with known answers for the tests and benchmarks: a room of 6 x 5 x 2.6 m with furniture, seen
/// by a Kinect-like camera that is carried along.
namespace stdc::test {

struct SceneOptions {
  int poses = 30, fixed_poses = 15;
  int points = 3000;
  int observations_per_point = 7;  ///< at most, in neighbouring poses
  int min_observations = 2;        ///< points that are seen less often are left out
  double step = 0.12;              ///< distance between poses [m]
  double outliers = 0.07;          ///< share of wrong pixels
  double edge_outliers = 0.05;     ///< share of depths read on the wrong side of an edge
  double missing_depth = 0.15;     ///< share, beside those that are out of the sensor's range
  double depth_range = 5.0;        ///< [m]
  double pose_error = 0.01;        ///< initial error, metres and radians per axis
  double point_error = 0.03;       ///< initial error per axis [m]
  double noise = 1.0;              ///< factor of the measurement noise
  NoiseSettings sigma{.pixel_sigma = 1.0, .inverse_depth_sigma = 0.005};
  std::uint64_t seed = 1;
};

struct BundleScene {
  Camera camera;
  NoiseSettings sigma;
  BundleProblem problem;         ///< with initial errors
  std::vector<Pose> true_poses;  ///< cam_from_world
  std::vector<Eigen::Vector3d> true_points;
  std::vector<std::uint8_t> pixel_is_outlier;  ///< per observation
  std::vector<std::uint8_t> depth_is_outlier;  ///< per observation
};

/// Whether two poses have the same bytes; padding between their fields does not count.
bool same(const Pose& a, const Pose& b);

Eigen::Vector3d normal3(Random& random, double sigma);

Pose disturbed(const Pose& pose, Random& random, double metres, double radians);

/// The camera after `distance` metres on an oval through the room, looking outwards (x right, y down, z
/// forward).
Pose camera_on_path(double distance);

/// A point on a wall, the floor, or in the zone of the furniture before the walls.
Eigen::Vector3d point_in_room(Random& random);

BundleScene make_scene(const SceneOptions& options);

/// Observations of fixed landmarks by the first camera of a scene.
struct PoseScene {
  Camera camera;
  NoiseSettings sigma;
  Pose truth;
  std::vector<PoseObservation> observations;
  std::vector<std::uint8_t> pixel_is_outlier, depth_is_outlier;
};

PoseScene make_pose_scene(const SceneOptions& options, int observations);

}  // namespace stdc::test
