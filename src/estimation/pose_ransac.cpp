#include "estimation/pose_ransac.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "estimation/alignment.hpp"

namespace stdc {
namespace {

int count_inliers(const Camera& camera, std::span<const PoseObservation> observations,
                  const Pose& cam_from_world, double gate) {
  int inliers = 0;
  for (const PoseObservation& o : observations) {
    const Eigen::Vector3d point = cam_from_world * o.point_in_world;
    if (!(point.z() > 0.05)) continue;
    const double reach = gate * o.scale;
    inliers += (camera.project(point) - o.pixel).squaredNorm() <= reach * reach ? 1 : 0;
  }
  return inliers;
}

/// Trials after which three inliers were drawn at least once, with some confidence.
double trials_needed(double inlier_share, double confidence) {
  const double good = inlier_share * inlier_share * inlier_share;
  if (good >= 1) return 1;
  return std::log(1 - confidence) / std::log1p(-good);
}

/// A rotation about their line would be free.
bool on_a_line(const std::array<Eigen::Vector3d, 3>& points) {
  const Eigen::Vector3d a = points[1] - points[0], b = points[2] - points[0], c = points[2] - points[1];
  const double max_side = std::max({a.norm(), b.norm(), c.norm()});
  constexpr double kMinFlatness = 0.1;  // height over base
  return !(a.cross(b).norm() > kMinFlatness * max_side * max_side);
}

}  // namespace

std::optional<Pose> find_pose(const Camera& camera, std::span<const PoseObservation> observations,
                              const PoseRansacSettings& settings) {
  std::vector<const PoseObservation*> with_depth;
  for (const PoseObservation& o : observations) {
    if (o.depth > 0) with_depth.push_back(&o);
  }
  if (with_depth.size() < 3) return {};
  Random random(settings.seed);
  std::optional<Pose> best;
  int best_count = settings.min_inliers - 1;
  double needed = settings.trials;
  for (int trial = 0; trial < settings.trials && trial < needed; ++trial) {
    std::array<Eigen::Vector3d, 3> world, cam;
    for (std::size_t k = 0; k < 3; ++k) {
      const PoseObservation& o = *with_depth[random.below(static_cast<std::uint32_t>(with_depth.size()))];
      world[k] = o.point_in_world;
      cam[k] = camera.unproject(o.pixel, o.depth);
    }
    if (on_a_line(world)) continue;
    const std::optional<Pose> cam_from_world = align_points(world, cam);
    if (!cam_from_world) continue;
    const int inliers = count_inliers(camera, observations, *cam_from_world, settings.gate);
    if (inliers <= best_count) continue;
    best_count = inliers;
    best = cam_from_world;
    needed = trials_needed(static_cast<double>(inliers) / static_cast<double>(observations.size()),
                           settings.confidence);
  }
  return best;
}

}  // namespace stdc
