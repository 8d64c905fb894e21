#include "estimation/bundle_adjustment.hpp"

#include <algorithm>
#include <cmath>

#include "estimation/bundle_weights.hpp"
#include "estimation/huber.hpp"
#include "estimation/packed_bundle.hpp"
#include "estimation/schur_step.hpp"

namespace stdc {
namespace {

using kernels::kLanes;

constexpr double kFirstDamping = 1e-4;
constexpr double kMinDamping = 1e-9;
constexpr double kMaxDamping = 1e8;
constexpr kernels::Gate kInlier{kChiSquare95Pixel, kChiSquare95Depth};

/// Poses and points between which the solver steps.
struct State {
  std::vector<Eigen::Quaterniond> rotation;  // of each slot, cam_from_world
  std::vector<kernels::BundleView> views;    // of each pose
  std::vector<kernels::BundlePoint> points;
};

void set_rotation(const Eigen::Quaterniond& rotation, kernels::BundleView* view) {
  const Eigen::Matrix3d matrix = rotation.toRotationMatrix();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) view->rows[r][c] = matrix(r, c);
  }
}

State initial_state(const BundleProblem& problem, const PackedBundle& packed) {
  State state;
  state.views.resize(problem.cam_from_world.size());
  for (std::size_t k = 0; k < state.views.size(); ++k) {
    const Pose& pose = problem.cam_from_world[k];
    set_rotation(pose.rotation, &state.views[k]);
    const Eigen::Vector3d centre = pose.centre();
    for (int r = 0; r < 3; ++r) state.views[k].rows[r][3] = centre[r];
  }
  for (const std::int32_t pose : packed.slot_pose) {
    state.rotation.push_back(problem.cam_from_world[static_cast<std::size_t>(pose)].rotation);
  }
  state.points.resize(problem.points.size());
  for (std::size_t k = 0; k < state.points.size(); ++k) {
    for (int r = 0; r < 3; ++r) state.points[k].position[r] = problem.points[k][r];
  }
  return state;
}

class BundleSolver {
 public:
  BundleSolver(const Camera& camera, const BundleProblem& problem, PackedBundle& packed)
      : camera_{camera.fx, camera.fy, camera.cx, camera.cy},
        packed_(packed),
        state_(initial_state(problem, packed)),
        trial_(state_),
        terms_(packed.packets.size()),
        step_(kernels_, packed) {}

  /// Robust cost (half of the sum) of what takes part.
  double linearise(const State& state) {
    return kernels_.linearise_bundle(packed_.packets.data(), packed_.packets.size(), state.views.data(),
                                     state.points.data(), camera_, terms_.data());
  }
  /// Robust cost of all observations; selects again which of them take part.
  double classify(const kernels::Gate& gate) {
    return kernels_.classify_bundle(packed_.packets.data(), packed_.packets.size(), state_.views.data(),
                                    state_.points.data(), camera_, gate);
  }

  /// Levenberg-Marquardt (gain ratio: Nielsen 1999). Counts the linear systems solved.
  void minimise(int iterations, double min_relative_decrease, int* solved) {
    double cost = linearise(state_);
    double growth = 4.0;
    for (int i = 0; i < iterations && damping_ <= kMaxDamping; ++i) {
      ++*solved;
      const double before = cost;
      bool accepted = false;
      if (step_.solve(terms_, state_.points, damping_, &trial_.points)) {
        stepped_ = true;
        const double expected = step_.expected_decrease();
        if (!(expected > 1e-12 * cost)) return;
        move_cameras();
        const double there = linearise(trial_);
        accepted = std::isfinite(there) && there < cost;
        if (accepted) {
          std::swap(state_, trial_);
          const double gain = 2.0 * (cost - there) / expected - 1.0;
          damping_ = std::max(damping_ * std::clamp(1.0 - gain * gain * gain, 0.1, 2.0), kMinDamping);
          growth = 4.0;
          cost = there;
        } else {
          linearise(state_);
        }
      }
      if (!accepted) {
        damping_ *= growth;
        growth *= 2.0;
      } else if (before - cost < min_relative_decrease * before) {
        return;
      }
    }
  }

  /// Whether a linear system could be solved at all.
  bool stepped() const { return stepped_; }
  const State& state() const { return state_; }

 private:
  void move_cameras() {
    for (std::size_t slot = 0; slot < state_.rotation.size(); ++slot) {
      const double* step = step_.camera_step(slot);
      const auto pose = static_cast<std::size_t>(packed_.slot_pose[slot]);
      trial_.rotation[slot] =
          (state_.rotation[slot] * rotation_exp({step[3], step[4], step[5]})).normalized();
      set_rotation(trial_.rotation[slot], &trial_.views[pose]);
      for (int r = 0; r < 3; ++r) trial_.views[pose].rows[r][3] = state_.views[pose].rows[r][3] - step[r];
    }
  }

  const kernels::Table& kernels_ = kernels::best();
  kernels::Intrinsics camera_;
  PackedBundle& packed_;
  State state_, trial_;
  std::vector<kernels::BundleTerm> terms_;
  SchurStep step_;
  double damping_ = kFirstDamping;
  bool stepped_ = false;
};

void write_back(const State& state, const PackedBundle& packed, BundleProblem* problem) {
  for (std::size_t s = 0; s < packed.slot_pose.size(); ++s) {
    const auto pose = static_cast<std::size_t>(packed.slot_pose[s]);
    const auto& rows = state.views[pose].rows;
    const Eigen::Vector3d centre(rows[0][3], rows[1][3], rows[2][3]);
    problem->cam_from_world[pose] = Pose(state.rotation[s], -(state.rotation[s] * centre));
  }
  for (std::size_t p = 0; p < problem->points.size(); ++p) {
    const bool is_seen = packed.moving_start[p] != packed.moving_start[p + 1] ||
                         packed.fixed_start[p] != packed.fixed_start[p + 1];
    if (!is_seen) continue;
    for (int r = 0; r < 3; ++r) problem->points[p][r] = state.points[p].position[r];
  }
}

}  // namespace

BundleResult bundle_adjust(const Camera& camera, BundleProblem& problem, const NoiseSettings& noise,
                           const BundleSettings& settings) {
  BundleResult result;
  result.inlier.assign(problem.observations.size(), 0);
  result.depth_inlier.assign(problem.observations.size(), 0);
  std::optional<PackedBundle> packed = pack_bundle(problem, noise);
  if (!packed) return result;

  BundleSolver solver(camera, problem, *packed);
  result.initial_cost = solver.linearise(solver.state());
  solver.minimise(settings.robust_iterations, settings.min_relative_decrease, &result.iterations);
  result.final_cost = solver.classify(kInlier);
  if (settings.final_iterations > 0) {
    if (settings.loss_width > 0) weigh_by_residuals(settings.loss_width, *packed);
    solver.minimise(settings.final_iterations, settings.min_relative_decrease, &result.iterations);
    result.final_cost = solver.classify(kInlier);
  }
  if (!solver.stepped() || !std::isfinite(result.initial_cost) || !std::isfinite(result.final_cost)) {
    result.final_cost = result.initial_cost;
    return result;
  }
  result.usable = true;
  for (std::size_t k = 0; k < packed->origin.size(); ++k) {
    if (packed->origin[k] == PackedBundle::kNone) continue;
    const kernels::BundlePacket& packet = packed->packets[k / kLanes];
    result.inlier[packed->origin[k]] = packet.used_inverse_sigma[k % kLanes] > 0 ? 1 : 0;
    result.depth_inlier[packed->origin[k]] = packet.used_depth_weight[k % kLanes] > 0 ? 1 : 0;
  }
  write_back(solver.state(), *packed, &problem);
  return result;
}

}  // namespace stdc
