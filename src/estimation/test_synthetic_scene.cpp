#include "estimation/test_synthetic_scene.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <optional>

namespace stdc::test {

bool same(const Pose& a, const Pose& b) {
  using Bits = std::array<std::uint64_t, 7>;
  const auto bits = [](const Pose& pose) {
    const Eigen::Vector4d& q = pose.rotation.coeffs();
    const Eigen::Vector3d& t = pose.translation;
    return std::bit_cast<Bits>(std::array<double, 7>{q[0], q[1], q[2], q[3], t[0], t[1], t[2]});
  };
  return bits(a) == bits(b);
}

Eigen::Vector3d normal3(Random& random, double sigma) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return sigma * Eigen::Vector3d(x, y, z);
}

Pose disturbed(const Pose& pose, Random& random, double metres, double radians) {
  Vector6d twist;
  twist.head<3>() = normal3(random, metres);
  twist.tail<3>() = normal3(random, radians);
  return Pose::exp(twist) * pose;
}

Pose camera_on_path(double distance) {
  const double angle = distance / 1.2;
  const Eigen::Vector3d centre(1.4 * std::cos(angle), 1.0 * std::sin(angle),
                               1.3 + 0.2 * std::sin(3.1 * angle));
  const double heading = angle + 0.3 * std::sin(2.3 * angle), pitch = 0.2 * std::sin(1.7 * angle);
  const Eigen::Vector3d forward(std::cos(heading) * std::cos(pitch), std::sin(heading) * std::cos(pitch),
                                std::sin(pitch));
  Eigen::Matrix3d world_from_cam;
  world_from_cam.col(2) = forward;
  world_from_cam.col(0) = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  world_from_cam.col(1) = world_from_cam.col(2).cross(world_from_cam.col(0));
  const Eigen::Matrix3d rotation = world_from_cam.transpose();
  return Pose(rotation, -(rotation * centre));
}

Eigen::Vector3d point_in_room(Random& random) {
  const double x = random.uniform(-3.0, 3.0), y = random.uniform(-2.5, 2.5), z = random.uniform(0.0, 2.6);
  const double inset = random.uniform() < 0.4 ? random.uniform(0.0, 0.7) : 0.0;
  switch (random.below(5)) {
    case 0:
      return {3.0 - inset, y, z};
    case 1:
      return {-3.0 + inset, y, z};
    case 2:
      return {x, 2.5 - inset, z};
    case 3:
      return {x, -2.5 + inset, z};
    default:
      return {x, y, 0.0 + inset};
  }
}

namespace {

struct Measurement {
  Eigen::Vector2d pixel;
  float depth, scale;
  bool pixel_is_outlier, depth_is_outlier;
};

/// What the camera measures of a point, or nothing if it is out of view.
std::optional<Measurement> measure(const SceneOptions& options, const Camera& camera, const Pose& pose,
                                   const Eigen::Vector3d& point, Random& random) {
  const Eigen::Vector3d p = pose * point;
  if (p.z() < 0.4) return std::nullopt;
  const Eigen::Vector2d ideal = camera.project(p);
  if (ideal.x() < 0 || ideal.y() < 0 || ideal.x() > camera.width - 1 || ideal.y() > camera.height - 1) {
    return std::nullopt;
  }
  Measurement m{};
  m.scale = static_cast<float>(std::pow(1.2, random.below(7)));
  const double sigma = options.noise * options.sigma.pixel_sigma * m.scale;
  const double nu = random.normal(), nv = random.normal(), nd = random.normal();
  m.pixel = ideal + sigma * Eigen::Vector2d(nu, nv);
  m.depth = static_cast<float>(1.0 / (1.0 / p.z() + options.noise * options.sigma.inverse_depth_sigma * nd));
  if (random.uniform() < options.edge_outliers) {
    m.depth_is_outlier = true;
    m.depth = static_cast<float>(p.z() + random.uniform(0.3, 1.5));
  }
  if (random.uniform() < options.outliers) {
    m.pixel_is_outlier = true;
    const double direction = random.uniform(0, 2 * M_PI), length = random.uniform(8.0, 60.0);
    m.pixel += length * m.scale * Eigen::Vector2d(std::cos(direction), std::sin(direction));
  }
  if (random.uniform() < options.missing_depth || p.z() > options.depth_range) m.depth = 0;
  return m;
}

}  // namespace

BundleScene make_scene(const SceneOptions& options) {
  BundleScene scene;
  scene.sigma = options.sigma;
  Random random(options.seed);
  BundleProblem& problem = scene.problem;
  for (int k = 0; k < options.poses; ++k) {
    scene.true_poses.push_back(camera_on_path(k * options.step));
    const bool fixed = k < options.fixed_poses;
    problem.pose_fixed.push_back(fixed ? 1 : 0);
    problem.cam_from_world.push_back(
        fixed ? scene.true_poses.back()
              : disturbed(scene.true_poses.back(), random, options.pose_error, options.pose_error));
  }
  while (static_cast<int>(scene.true_points.size()) < options.points) {
    const Eigen::Vector3d point = point_in_room(random);
    const auto first = random.below(static_cast<std::uint32_t>(options.poses));
    const std::size_t before = problem.observations.size();
    for (auto k = static_cast<std::size_t>(first); k < scene.true_poses.size(); ++k) {
      if (problem.observations.size() - before == static_cast<std::size_t>(options.observations_per_point))
        break;
      const auto m = measure(options, scene.camera, scene.true_poses[k], point, random);
      if (!m) continue;
      problem.observations.push_back({static_cast<std::int32_t>(k),
                                      static_cast<std::int32_t>(scene.true_points.size()),
                                      m->pixel.cast<float>(), m->depth, m->scale});
      scene.pixel_is_outlier.push_back(m->pixel_is_outlier ? 1 : 0);
      scene.depth_is_outlier.push_back(m->depth_is_outlier ? 1 : 0);
    }
    if (problem.observations.size() - before < static_cast<std::size_t>(options.min_observations)) {
      problem.observations.resize(before);
      scene.pixel_is_outlier.resize(before);
      scene.depth_is_outlier.resize(before);
      continue;
    }
    scene.true_points.push_back(point);
    problem.points.push_back(point + normal3(random, options.point_error));
  }
  return scene;
}

PoseScene make_pose_scene(const SceneOptions& options, int observations) {
  PoseScene scene;
  scene.sigma = options.sigma;
  Random random(options.seed);
  scene.truth = camera_on_path(random.uniform(0.0, 7.0));
  while (static_cast<int>(scene.observations.size()) < observations) {
    const Eigen::Vector3d point = point_in_room(random);
    const auto m = measure(options, scene.camera, scene.truth, point, random);
    if (!m) continue;
    scene.observations.push_back({point, m->pixel, m->depth, m->scale});
    scene.pixel_is_outlier.push_back(m->pixel_is_outlier ? 1 : 0);
    scene.depth_is_outlier.push_back(m->depth_is_outlier ? 1 : 0);
  }
  return scene;
}

}  // namespace stdc::test
