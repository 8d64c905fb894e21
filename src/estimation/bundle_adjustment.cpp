#include "estimation/bundle_adjustment.hpp"

#include <algorithm>
#include <cmath>

#include "estimation/packed_bundle.hpp"

namespace stdc {
namespace {

using kernels::kLanes;
using kernels::kSegment;

constexpr double kFirstDamping = 1e-4;
constexpr double kSmallestDamping = 1e-9;
constexpr double kLargestDamping = 1e8;

struct alignas(64) Block {
  double value[kernels::kBlock];
};
struct alignas(64) Segment {
  double value[kSegment];
};

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
        terms_(packed.fours.size()),
        points_(problem.points.size()),
        blocks_(packed.pattern.blocks()),
        gradient_(packed.pattern.size()),
        step_(packed.pattern.size()),
        diagonal_(packed.pattern.size()),
        scratch_(packed.most_moving) {}

  /// Robust cost (half of the sum) of what takes part.
  double linearise(const State& state) {
    return kernels_.linearise_bundle(packed_.fours.data(), packed_.fours.size(), state.views.data(),
                                     state.points.data(), camera_, terms_.data());
  }
  /// Robust cost of all observations; tells anew which take part.
  double classify() {
    return kernels_.classify_bundle(packed_.fours.data(), packed_.fours.size(), state_.views.data(),
                                    state_.points.data(), camera_);
  }

  /// Levenberg-Marquardt (gain ratio: Nielsen 1999). Counts the linear systems solved.
  void minimise(int iterations, double relative_decrease_to_stop, int* solved) {
    double cost = linearise(state_);
    double growth = 4.0;
    for (int i = 0; i < iterations && damping_ <= kLargestDamping; ++i) {
      ++*solved;
      double expected = 0;
      const double before = cost;
      bool accepted = false;
      if (find_step(&expected)) {
        stepped_ = true;
        if (!(expected > 1e-12 * cost)) return;
        const double there = linearise(trial_);
        accepted = std::isfinite(there) && there < cost;
        if (accepted) {
          std::swap(state_, trial_);
          const double gain = 2.0 * (cost - there) / expected - 1.0;
          damping_ = std::max(damping_ * std::clamp(1.0 - gain * gain * gain, 0.1, 2.0), kSmallestDamping);
          growth = 4.0;
          cost = there;
        } else {
          linearise(state_);
        }
      }
      if (!accepted) {
        damping_ *= growth;
        growth *= 2.0;
      } else if (before - cost < relative_decrease_to_stop * before) {
        return;
      }
    }
  }

  /// Whether a linear system could be solved at all.
  bool stepped() const { return stepped_; }
  const State& state() const { return state_; }

 private:
  /// Solves the damped system into trial_; `expected`: the decrease of the cost in the linear model.
  bool find_step(double* expected) {
    std::fill(blocks_.begin(), blocks_.end(), Block{});
    std::fill(gradient_.begin(), gradient_.end(), Segment{});
    std::fill(step_.begin(), step_.end(), Segment{});
    std::fill(diagonal_.begin(), diagonal_.end(), Segment{});
    const kernels::SchurInput in{
        packed_.fours.data(),       terms_.data(),  state_.views.data(), state_.points.data(),
        packed_.point_start.data(), points_.size(), packed_.slot.data(), packed_.diagonal_block.data(),
        packed_.pair_block.data(),  damping_};
    // Blocks, segments and scratch are arrays of plain doubles to the kernels.
    kernels_.eliminate_points(in, {points_.data(), numbers(blocks_), numbers(gradient_), numbers(step_),
                                   numbers(diagonal_), numbers(scratch_)});
    damp_cameras();
    const kernels::BlockColumns columns{packed_.pattern.size(), packed_.pattern.starts().data(),
                                        packed_.pattern.rows().data()};
    if (!kernels_.factorise(columns, numbers(blocks_))) return false;
    kernels_.solve(columns, numbers(blocks_), numbers(step_));
    *expected = 0.5 * (kernels_.substitute_points(in, points_.data(), numbers(step_), trial_.points.data()) +
                       step_cameras());
    return std::isfinite(*expected);
  }

  /// Adds the damping to the diagonal, completes the right-hand side.
  void damp_cameras() {
    for (std::size_t s = 0; s < step_.size(); ++s) {
      double* block = blocks_[packed_.diagonal_block[s]].value;
      for (std::size_t k = 0; k < 6; ++k) {
        double& diagonal = diagonal_[s].value[k];
        diagonal = diagonal > 0 ? damping_ * diagonal : 1.0;  // a camera that sees nothing stays
        block[8 * k + k] += diagonal;
        step_[s].value[k] = -(gradient_[s].value[k] + step_[s].value[k]);
      }
    }
  }

  /// Moves the cameras of trial_; twice the decrease expected of it.
  double step_cameras() {
    double expected = 0;
    for (std::size_t s = 0; s < step_.size(); ++s) {
      const double* step = step_[s].value;
      for (std::size_t k = 0; k < 6; ++k) {
        expected += step[k] * (diagonal_[s].value[k] * step[k] - gradient_[s].value[k]);
      }
      const auto pose = static_cast<std::size_t>(packed_.slot_pose[s]);
      trial_.rotation[s] = (state_.rotation[s] * rotation_exp({step[3], step[4], step[5]})).normalized();
      set_rotation(trial_.rotation[s], &trial_.views[pose]);
      for (int r = 0; r < 3; ++r) trial_.views[pose].rows[r][3] = state_.views[pose].rows[r][3] - step[r];
    }
    return expected;
  }

  template <typename T>
  static double* numbers(std::vector<T>& list) {
    return reinterpret_cast<double*>(list.data());
  }

  struct alignas(64) Columns {
    double value[24];
  };

  const kernels::Table& kernels_ = kernels::best();
  kernels::Intrinsics camera_;
  PackedBundle& packed_;
  State state_, trial_;
  std::vector<kernels::BundleTerm> terms_;
  std::vector<kernels::PointSystem> points_;
  std::vector<Block> blocks_;
  std::vector<Segment> gradient_, step_, diagonal_;
  std::vector<Columns> scratch_;
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
    if (packed.point_start[p] == packed.point_start[p + 1]) continue;
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
  solver.minimise(settings.robust_iterations, settings.relative_decrease_to_stop, &result.iterations);
  result.final_cost = solver.classify();
  if (settings.final_iterations > 0) {
    solver.minimise(settings.final_iterations, settings.relative_decrease_to_stop, &result.iterations);
    result.final_cost = solver.classify();
  }
  if (!solver.stepped() || !std::isfinite(result.initial_cost) || !std::isfinite(result.final_cost)) {
    result.final_cost = result.initial_cost;
    return result;
  }
  result.usable = true;
  for (std::size_t k = 0; k < packed->origin.size(); ++k) {
    const kernels::BundleFour& four = packed->fours[k / kLanes];
    result.inlier[packed->origin[k]] = four.used_inverse_sigma[k % kLanes] > 0 ? 1 : 0;
    result.depth_inlier[packed->origin[k]] = four.used_depth_weight[k % kLanes] > 0 ? 1 : 0;
  }
  write_back(solver.state(), *packed, &problem);
  return result;
}

}  // namespace stdc
