#include "motion/flow/static_flow.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/pose.hpp"
#include "core/random.hpp"

namespace stdc {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMinZ = 0.1, kShutterPrior = 1e-4;
using Vector9d = Eigen::Matrix<double, 9, 1>;

/// The homography of four points; identity of scale where the last entry is 1. False if three are in line.
bool solve_homography(const std::array<const FlowPoint*, 4>& points, Matrix3d& homography) {
  Eigen::Matrix<double, 8, 8> system;
  Eigen::Matrix<double, 8, 1> right;
  for (int i = 0; i < 4; ++i) {
    const Vector2d &p = points[static_cast<std::size_t>(i)]->here,
                   &q = points[static_cast<std::size_t>(i)]->there;
    system.row(2 * i) << p.x(), p.y(), 1, 0, 0, 0, -q.x() * p.x(), -q.x() * p.y();
    system.row(2 * i + 1) << 0, 0, 0, p.x(), p.y(), 1, -q.y() * p.x(), -q.y() * p.y();
    right.segment<2>(2 * i) = q;
  }
  const Eigen::PartialPivLU<Eigen::Matrix<double, 8, 8>> lu(system);
  constexpr double kSingular = 1e-9;
  if (!(std::abs(lu.determinant()) > kSingular)) return false;
  const Eigen::Matrix<double, 8, 1> h = lu.solve(right);
  homography << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1;
  return homography.allFinite();
}

/// Sum of what each point costs: its squared residual, bounded.
double cost_of(const StaticFlow& flow, const std::vector<const FlowPoint*>& points, double threshold) {
  double cost = 0;
  for (const FlowPoint* point : points) {
    const double r = flow.residual(*point) / threshold;
    cost += std::min(r * r, 1.0);
  }
  return cost;
}

StaticFlow best_homography(const std::vector<const FlowPoint*>& points, double threshold, Random& random) {
  constexpr int kTrials = 120;
  StaticFlow best;
  double best_cost = cost_of(best, points, threshold);
  for (int trial = 0; trial < kTrials; ++trial) {
    std::array<const FlowPoint*, 4> sample;
    for (auto& point : sample) point = points[random.below(static_cast<std::uint32_t>(points.size()))];
    StaticFlow flow;
    if (!solve_homography(sample, flow.homography)) continue;
    const double cost = cost_of(flow, points, threshold);
    if (cost >= best_cost) continue;
    best_cost = cost;
    best = flow;
  }
  return best;
}

/// One step of Gauss-Newton with Tukey's weight.
void improve(StaticFlow& flow, const std::vector<const FlowPoint*>& points, double scale) {
  Eigen::Matrix<double, 9, 9> information = Eigen::Matrix<double, 9, 9>::Zero();
  Vector9d gradient = Vector9d::Zero();
  for (const FlowPoint* point : points) {
    const Vector3d turned = flow.homography * (point->here.homogeneous() + flow.shutter_shift(point->here));
    const Vector3d p = turned + point->inverse_depth * flow.parallax;
    if (!(p.z() > kMinZ)) continue;
    const Vector2d error = p.hnormalized() - point->there;
    const double share = error.dot(point->certainty * error) / (scale * scale);
    if (share >= 1) continue;
    const Eigen::Matrix2d weight = (1 - share) * (1 - share) * point->certainty;
    Eigen::Matrix<double, 2, 3> by_point;
    by_point << 1 / p.z(), 0, -p.x() / (p.z() * p.z()), 0, 1 / p.z(), -p.y() / (p.z() * p.z());
    Eigen::Matrix<double, 2, 9> jacobian;
    jacobian << point->inverse_depth * by_point, -by_point * skew(turned),
        -point->here.y() * by_point * flow.homography * skew(point->here.homogeneous());
    information += jacobian.transpose() * weight * jacobian;
    gradient += jacobian.transpose() * weight * error;
  }
  // Shutters are quick: what they do to an image is little.
  const double ridge = kShutterPrior * information.trace();
  information.diagonal().array() += 1e-9 * (1 + information.trace());
  information.diagonal().tail<3>().array() += ridge;
  gradient.tail<3>() += ridge * flow.shutter;
  const Vector9d step = information.ldlt().solve(gradient);
  if (!step.allFinite()) return;
  flow.parallax -= step.head<3>();
  flow.homography = rotation_exp(-step.segment<3>(3)).toRotationMatrix() * flow.homography;
  flow.shutter -= step.tail<3>();
}

/// The rotation that is nearest to a homography.
Matrix3d nearest_rotation(const Matrix3d& homography) {
  const Eigen::JacobiSVD<Matrix3d> svd(homography, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d rotation = svd.matrixU() * svd.matrixV().transpose();
  if (rotation.determinant() < 0) rotation = Matrix3d::Identity();
  return rotation;
}

/// What a homography alone explains may be little: the scale begins wide and narrows as parallax is found.
StaticFlow refined(StaticFlow flow, const std::vector<const FlowPoint*>& points, double threshold) {
  flow.homography = nearest_rotation(flow.homography);
  for (const double scale : {16.0, 12.0, 8.0, 6.0, 4.0, 3.0, 3.0, 3.0})
    improve(flow, points, scale * threshold);
  return flow;
}

}  // namespace

bool StaticFlow::predict(const Vector2d& here, double inverse_depth, Vector2d& there) const {
  const Vector3d p = homography * (here.homogeneous() + shutter_shift(here)) + inverse_depth * parallax;
  if (!(p.z() > kMinZ)) return false;
  there = p.hnormalized();
  return true;
}

double StaticFlow::residual(const FlowPoint& point) const {
  constexpr double kBehind = 1e3;
  Vector2d farthest, nearest;
  if (!predict(point.here, point.min_inverse_depth, farthest) ||
      !predict(point.here, point.max_inverse_depth, nearest))
    return kBehind;
  const Vector2d line = nearest - farthest, error = point.there - farthest;
  const double length = line.squaredNorm();
  const double along = length > 0 ? std::clamp(error.dot(line) / length, 0.0, 1.0) : 0;
  const Vector2d off = error - along * line;
  return std::sqrt(off.dot(point.certainty * off));
}

std::optional<StaticFlow> fit_static_flow(const std::vector<FlowPoint>& points, double threshold,
                                          std::uint64_t seed, const StaticFlow& guess) {
  constexpr std::size_t kMinPoints = 16;
  std::vector<const FlowPoint*> usable;
  for (const FlowPoint& point : points) {
    if (point.usable && point.inverse_depth != 0) usable.push_back(&point);
  }
  if (usable.size() < kMinPoints) return std::nullopt;
  Random random(seed);
  StaticFlow flow = refined(best_homography(usable, 3 * threshold, random), usable, threshold);
  const StaticFlow other = refined(guess, usable, threshold);
  if (cost_of(other, usable, threshold) < cost_of(flow, usable, threshold)) flow = other;
  std::vector<double> residuals;
  for (const FlowPoint* point : usable) {
    const double r = flow.residual(*point);
    if (r < threshold) residuals.push_back(r);
  }
  if (residuals.size() < std::max(kMinPoints, usable.size() / 4)) return std::nullopt;
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  flow.sigma = *middle;
  return flow;
}

}  // namespace stdc
