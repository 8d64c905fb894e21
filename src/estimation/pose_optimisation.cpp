#include "estimation/pose_optimisation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "estimation/huber.hpp"
#include "estimation/kernels/kernels.hpp"

namespace stdc {
namespace {

using kernels::kLanes;

// Larger coordinates [m or px] are taken for garbage; squares of them would overflow further down.
constexpr double kMaxCoordinate = 1e8;
// A round ends when the next step would lower the cost by less than this: it is in units of chi-square, so
// the pose then lies within sqrt(2 * this) of its own standard deviation from the minimum.
constexpr double kSettled = 1e-5;
constexpr double kPoseFirstDamping = 1e-6;
constexpr double kPoseMaxDamping = 1e6;
// A unit direction of the pose (scaled to unit information per coordinate) that keeps less than this share of
// its information once the others are estimated too is not determined by the observations.
constexpr double kSingular = 1e-10;
constexpr kernels::Gate kPoseInlier{kChiSquare95Pixel, kChiSquare95Depth};

bool is_sane(const PoseObservation& o) {
  return o.point_in_world.cwiseAbs().maxCoeff() < kMaxCoordinate &&
         o.pixel.cwiseAbs().maxCoeff() < kMaxCoordinate && o.point_in_world.allFinite() &&
         o.pixel.allFinite() && o.scale > 0 && std::isfinite(o.scale);
}

/// The sane observations in groups of four, and for each of them its index in the list given.
struct Problem {
  std::vector<kernels::PosePacket> packets;
  std::vector<std::uint32_t> index;
};

Problem pack(std::span<const PoseObservation> observations, const NoiseSettings& noise) {
  Problem problem;
  problem.packets.resize((observations.size() + kLanes - 1) / kLanes);  // zeroed: empty lanes weigh nothing
  problem.index.reserve(observations.size());
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const PoseObservation& o = observations[i];
    if (!is_sane(o)) continue;
    kernels::PosePacket& packet = problem.packets[problem.index.size() / kLanes];
    const std::size_t lane = problem.index.size() % kLanes;
    problem.index.push_back(static_cast<std::uint32_t>(i));
    const bool has_depth = o.depth > 0 && std::isfinite(o.depth);
    packet.x[lane] = o.point_in_world.x();
    packet.y[lane] = o.point_in_world.y();
    packet.z[lane] = o.point_in_world.z();
    packet.u[lane] = o.pixel.x();
    packet.v[lane] = o.pixel.y();
    packet.inverse_sigma[lane] = 1.0 / (noise.pixel_sigma * o.scale);
    packet.inverse_depth[lane] = has_depth ? 1.0 / o.depth : 0.0;
    packet.depth_weight[lane] = has_depth ? 1.0 / noise.inverse_depth_sigma : 0.0;
    packet.use_pixel[lane] = 1.0;
    packet.use_depth[lane] = has_depth ? 1.0 : 0.0;
  }
  problem.packets.resize((problem.index.size() + kLanes - 1) / kLanes);
  return problem;
}

/// The system linearised at a pose.
struct Linearisation {
  Matrix6d hessian;
  Vector6d gradient;
  double cost;

  bool is_finite() const { return hessian.allFinite() && gradient.allFinite() && std::isfinite(cost); }
};

class PoseSolver {
 public:
  PoseSolver(const Camera& camera, Problem& problem, const PosePrior& prior)
      : camera_(camera),
        problem_(problem),
        prior_(prior),
        prior_from_world_(prior.cam_from_world.inverse()) {}

  /// With a gate, selects again which observations take part.
  Linearisation linearise(const Pose& pose, const kernels::Gate* gate) {
    kernels::PinholeView view{};
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(view.rotation) = pose.rotation_matrix();
    Eigen::Map<Eigen::Vector3d>(view.translation) = pose.translation;
    view.fx = camera_.fx, view.fy = camera_.fy, view.cx = camera_.cx, view.cy = camera_.cy;
    kernels::PoseSystem system;
    kernels_.linearise_pose(problem_.packets.data(), problem_.packets.size(), view, gate, &system);
    Linearisation result;
    for (int i = 0, k = 0; i < 6; ++i) {
      for (int j = i; j < 6; ++j, ++k) result.hessian(i, j) = result.hessian(j, i) = system.h[k];
    }
    result.gradient = Eigen::Map<const Vector6d>(system.g);
    result.cost = system.cost;
    add_prior(pose, &result);
    return result;
  }

  /// Levenberg-Marquardt from `pose`, whose linearisation is `at`; both are moved to the end point.
  void minimise(int iterations, Pose* pose, Linearisation* at) {
    double damping = kPoseFirstDamping, growth = 4.0;
    for (int i = 0; i < iterations && damping <= kPoseMaxDamping; ++i) {
      Matrix6d damped = at->hessian;
      const Vector6d added = damping * at->hessian.diagonal();
      damped.diagonal() += added;
      const Vector6d step = -damped.ldlt().solve(at->gradient);
      if (!step.allFinite()) return;
      const double expected = 0.5 * step.dot(added.cwiseProduct(step) - at->gradient);
      if (!(expected > kSettled)) return;
      const Pose trial = Pose::exp(step) * *pose;
      const Linearisation there = linearise(trial, nullptr);
      if (there.is_finite() && there.cost < at->cost) {
        const bool good = at->cost - there.cost > 0.25 * expected;
        *pose = trial;
        *at = there;
        damping = good ? std::max(0.1 * damping, 1e-12) : damping;
        growth = 4.0;
      } else {
        damping *= growth;
        growth *= 4.0;
      }
    }
  }

  /// What takes part now of each observation: 1 the pixel, 2 the depth.
  std::vector<std::uint8_t> selection() const {
    std::vector<std::uint8_t> chosen(problem_.index.size());
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const kernels::PosePacket& packet = problem_.packets[k / kLanes];
      chosen[k] = (packet.use_pixel[k % kLanes] > 0 ? 1 : 0) | (packet.use_depth[k % kLanes] > 0 ? 2 : 0);
    }
    return chosen;
  }

 private:
  /// The residual is log(pose * prior^-1); its Jacobian over a left perturbation is the identity to first
  /// order.
  void add_prior(const Pose& pose, Linearisation* at) const {
    if (prior_.information.isZero(0)) return;
    const Vector6d residual = (pose * prior_from_world_).log();
    const Vector6d weighted = prior_.information * residual;
    at->hessian += prior_.information;
    at->gradient += weighted;
    at->cost += 0.5 * residual.dot(weighted);
  }

  const Camera& camera_;
  Problem& problem_;
  const PosePrior& prior_;
  Pose prior_from_world_;
  const kernels::Table& kernels_ = kernels::best();
};

/// How many pixels take part in a selection.
std::size_t count(const std::vector<std::uint8_t>& selection) {
  return static_cast<std::size_t>(
      std::count_if(selection.begin(), selection.end(), [](std::uint8_t bits) { return (bits & 1) != 0; }));
}

bool is_determined(const Matrix6d& hessian) {
  if (!hessian.allFinite() || !(hessian.diagonal().minCoeff() > 0)) return false;
  const Vector6d scale = hessian.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6d scaled = scale.asDiagonal() * hessian * scale.asDiagonal();
  const Eigen::LDLT<Matrix6d> factors(scaled);
  return factors.info() == Eigen::Success && factors.vectorD().minCoeff() > kSingular;
}

}  // namespace

PoseOptimisationResult optimise_pose(const Camera& camera, std::span<const PoseObservation> observations,
                                     const Pose& initial_cam_from_world, const NoiseSettings& noise,
                                     const PoseOptimisationSettings& settings, const PosePrior& prior) {
  PoseOptimisationResult result;
  result.cam_from_world = initial_cam_from_world;
  result.inlier.assign(observations.size(), 0);
  result.depth_inlier.assign(observations.size(), 0);
  Problem problem = pack(observations, noise);
  const auto enough = static_cast<std::size_t>(std::max(settings.min_observations, 3));
  if (problem.index.size() < enough || !initial_cam_from_world.is_finite()) return result;

  PoseSolver solver(camera, problem, prior);
  Pose pose = initial_cam_from_world;
  Linearisation at = solver.linearise(pose, nullptr);
  std::vector<std::uint8_t> inlier = solver.selection();
  for (int round = 0; round < settings.rounds && at.is_finite(); ++round) {
    solver.minimise(settings.iterations_per_round, &pose, &at);
    at = solver.linearise(pose, &kPoseInlier);
    std::vector<std::uint8_t> now = solver.selection();
    if (now == inlier) break;
    inlier.swap(now);
  }
  if (count(inlier) < enough || !at.is_finite() || !is_determined(at.hessian)) return result;

  result.usable = true;
  result.cam_from_world = pose;
  result.inliers = static_cast<int>(count(inlier));
  result.information = at.hessian;
  for (std::size_t k = 0; k < inlier.size(); ++k) {
    result.inlier[problem.index[k]] = inlier[k] & 1;
    result.depth_inlier[problem.index[k]] = inlier[k] >> 1;
  }
  return result;
}

}  // namespace stdc
