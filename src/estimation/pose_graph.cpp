#include "estimation/pose_graph.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "estimation/block_pattern.hpp"
#include "estimation/huber.hpp"
#include "estimation/kernels/kernels.hpp"
#include "estimation/se3.hpp"

namespace stdc {
namespace {

constexpr double kGraphFirstDamping = 1e-6;
constexpr double kGraphMinDamping = 1e-10;
constexpr double kGraphMaxDamping = 1e8;
constexpr std::int32_t kFixed = -1;

template <std::size_t count>
struct alignas(64) Numbers {
  double value[count];
};
using Block = Numbers<kernels::kBlock>;
using Segment = Numbers<kernels::kSegment>;

class PoseGraphSolver {
 public:
  PoseGraphSolver(const PoseGraph& graph, const PoseGraphSettings& settings)
      : graph_(graph), settings_(settings), slot_(graph.node_from_world.size(), kFixed), pattern_(0) {
    for (const PoseGraphEdge& edge : graph.edges) {
      if (edge.a != edge.b && edge.a_from_b.is_finite() && edge.information.allFinite())
        edges_.push_back({&edge});
    }
    choose_slots();
    blocks_.resize(pattern_.blocks());
    matrix_.resize(pattern_.blocks());
    gradient_.resize(pattern_.size());
    step_.resize(pattern_.size());
  }

  bool has_work() const { return pattern_.size() > 0 && !edges_.empty(); }

  double cost(const std::vector<Pose>& poses) const {
    double sum = 0;
    for (const Edge& edge : edges_) {
      const Vector6d error = error_of(poses, *edge.it);
      sum += 0.5 * rho(*edge.it, error.dot(edge.it->information * error));
    }
    return sum;
  }

  /// Levenberg-Marquardt (gain ratio: Nielsen 1999). False if no step could be computed at all.
  bool minimise(std::vector<Pose>& poses, PoseGraphResult& result) {
    double damping = kGraphFirstDamping, growth = 4;
    result.final_cost = result.initial_cost = cost(poses);
    if (!std::isfinite(result.initial_cost)) return false;
    bool stepped = false;
    linearise(poses);
    while (result.iterations < settings_.iterations && damping <= kGraphMaxDamping) {
      ++result.iterations;
      const std::optional<double> expected = solve(damping);
      if (expected) {
        stepped = true;
        if (!(*expected > 1e-12 * result.final_cost)) break;
        std::vector<Pose> moved = move(poses);
        const double there = cost(moved), decrease = result.final_cost - there;
        if (std::isfinite(there) && decrease > 0) {
          poses = std::move(moved);
          const bool converged = decrease < settings_.min_relative_decrease * result.final_cost;
          result.final_cost = there;
          if (converged) break;
          const double gain = 2.0 * decrease / *expected - 1.0;
          damping = std::max(damping * std::clamp(1.0 - gain * gain * gain, 0.1, 2.0), kGraphMinDamping);
          growth = 4;
          linearise(poses);
          continue;
        }
      }
      damping *= growth;
      growth *= 2;
    }
    return stepped;
  }

 private:
  struct Edge {
    const PoseGraphEdge* it = nullptr;
    std::uint32_t block = 0;  ///< of the pair, if both nodes are free
  };

  void choose_slots() {
    const std::size_t nodes = slot_.size();
    const auto is_fixed = [&](std::size_t k) { return graph_.fixed[k] != 0; };
    bool any_fixed = false;
    for (std::size_t k = 0; k < nodes; ++k) any_fixed |= is_fixed(k);
    std::vector<std::int32_t> free;
    for (std::size_t k = any_fixed ? 0 : 1; k < nodes; ++k) {
      if (is_fixed(k)) continue;
      slot_[k] = static_cast<std::int32_t>(free.size());
      free.push_back(static_cast<std::int32_t>(k));
    }
    std::erase_if(edges_,
                  [&](const Edge& e) { return slot_[e.it->a] == kFixed && slot_[e.it->b] == kFixed; });
    BlockPattern given(free.size());
    for (const Edge& e : edges_) {
      if (both_free(e)) given.connect(slot_[e.it->a], slot_[e.it->b]);
    }
    const std::vector<std::int32_t> order = given.elimination_order();
    for (std::size_t s = 0; s < order.size(); ++s) slot_[free[order[s]]] = static_cast<std::int32_t>(s);
    pattern_ = given.permuted(order);
    pattern_.eliminate();
    for (Edge& e : edges_) {
      if (both_free(e))
        e.block = pattern_.block(std::max(slot_[e.it->a], slot_[e.it->b]),
                                 std::min(slot_[e.it->a], slot_[e.it->b]));
    }
  }

  bool both_free(const Edge& edge) const {
    return slot_[edge.it->a] != kFixed && slot_[edge.it->b] != kFixed;
  }

  static Vector6d error_of(const std::vector<Pose>& poses, const PoseGraphEdge& edge) {
    return (poses[edge.a] * poses[edge.b].inverse() * edge.a_from_b.inverse()).log();
  }

  double rho(const PoseGraphEdge& edge, double chi_square) const {
    return edge.robust ? huber_cost(chi_square, settings_.robust_chi_square) : chi_square;
  }

  void linearise(const std::vector<Pose>& poses) {
    std::fill(matrix_.begin(), matrix_.end(), Block{});
    std::fill(gradient_.begin(), gradient_.end(), Segment{});
    for (const Edge& edge : edges_) {
      const PoseGraphEdge& e = *edge.it;
      const Pose a_from_b = poses[e.a] * poses[e.b].inverse();
      const Vector6d error = (a_from_b * e.a_from_b.inverse()).log();
      const Vector6d weighted = e.information * error;
      const double chi_square = error.dot(weighted);
      const double weight = e.robust && chi_square > settings_.robust_chi_square
                                ? std::sqrt(settings_.robust_chi_square / chi_square)
                                : 1.0;
      // A step x of a moves the error by J x, a step of b by -J adjoint(a_from_b) x.
      const Matrix6d jacobian = inverse_left_jacobian(error);
      const Matrix6d transport = adjoint(a_from_b);
      const Matrix6d hessian = weight * (jacobian.transpose() * e.information * jacobian);
      const Vector6d gradient = weight * (jacobian.transpose() * weighted);
      const Matrix6d mixed = -hessian * transport;
      if (slot_[e.a] != kFixed) add_diagonal(slot_[e.a], hessian, gradient);
      if (slot_[e.b] != kFixed) {
        add_diagonal(slot_[e.b], -transport.transpose() * mixed, -transport.transpose() * gradient);
      }
      if (!both_free(edge)) continue;
      if (slot_[e.a] > slot_[e.b]) {
        add(edge.block, mixed);
      } else {
        add(edge.block, mixed.transpose());
      }
    }
  }

  void add(std::uint32_t block, const Matrix6d& values) {
    for (Eigen::Index c = 0; c < 6; ++c) {
      for (Eigen::Index r = 0; r < 6; ++r) matrix_[block].value[8 * c + r] += values(r, c);
    }
  }
  void add_diagonal(std::int32_t slot, const Matrix6d& hessian, const Vector6d& gradient) {
    add(pattern_.starts()[slot], hessian);
    for (Eigen::Index r = 0; r < 6; ++r) gradient_[slot].value[r] += gradient[r];
  }

  /// Computes the step for the last linearisation; by how much the cost should fall, or nothing if the system
  /// is singular.
  std::optional<double> solve(double damping) {
    blocks_ = matrix_;
    std::vector<Segment> damped(gradient_.size());
    for (std::size_t s = 0; s < gradient_.size(); ++s) {
      double* block = blocks_[pattern_.starts()[s]].value;
      for (std::size_t r = 0; r < 6; ++r) {
        const double diagonal = block[9 * r];
        damped[s].value[r] = diagonal > 0 ? damping * diagonal : 1.0;  // unobserved: stays
        block[9 * r] += damped[s].value[r];
        step_[s].value[r] = -gradient_[s].value[r];
      }
      step_[s].value[6] = step_[s].value[7] = 0;
    }
    const kernels::BlockColumns columns{pattern_.size(), pattern_.starts().data(), pattern_.rows().data()};
    auto* const blocks = reinterpret_cast<double*>(blocks_.data());  // the kernels take arrays of doubles
    if (!kernels_.factorise(columns, blocks)) return std::nullopt;
    kernels_.solve(columns, blocks, reinterpret_cast<double*>(step_.data()));
    double twice = 0;
    for (std::size_t s = 0; s < step_.size(); ++s) {
      for (std::size_t r = 0; r < 6; ++r) {
        const double step = step_[s].value[r];
        twice += step * (damped[s].value[r] * step - gradient_[s].value[r]);
      }
    }
    if (!std::isfinite(twice)) return std::nullopt;
    return 0.5 * twice;
  }

  std::vector<Pose> move(const std::vector<Pose>& poses) const {
    std::vector<Pose> moved = poses;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      if (slot_[k] == kFixed) continue;
      moved[k] = Pose::exp(Eigen::Map<const Vector6d>(step_[slot_[k]].value)) * poses[k];
    }
    return moved;
  }

  const PoseGraph& graph_;
  PoseGraphSettings settings_;
  const kernels::Table& kernels_ = kernels::best();
  std::vector<Edge> edges_;
  std::vector<std::int32_t> slot_;  ///< row of each node in the linear system
  BlockPattern pattern_;
  std::vector<Block> matrix_, blocks_;  ///< lower triangle; and as it is factorised
  std::vector<Segment> gradient_, step_;
};

}  // namespace

PoseGraphResult optimise_pose_graph(PoseGraph& graph, const PoseGraphSettings& settings) {
  PoseGraphResult result;
  const auto finite = [](const Pose& pose) { return pose.is_finite(); };
  if (!std::all_of(graph.node_from_world.begin(), graph.node_from_world.end(), finite)) return result;
  PoseGraphSolver solver(graph, settings);
  if (!solver.has_work()) return result;
  std::vector<Pose> poses = graph.node_from_world;
  result.usable = solver.minimise(poses, result);
  if (result.usable) {
    graph.node_from_world = std::move(poses);
  } else {
    result.final_cost = result.initial_cost;
  }
  return result;
}

}  // namespace stdc
