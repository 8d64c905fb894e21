#include "simulation/people/route.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stdc::simulation {
namespace {

using Eigen::Vector2d;

constexpr double kTurnRate = 2.4, kTurnAcceleration = 9;  // [rad/s], [rad/s^2]
constexpr double kAcceleration = 1.1;                     // [m/s^2]
constexpr double kLookAhead = 0.45;                       // look-ahead of the path follower [m]
constexpr double kArrived = 0.02;                         // [m]

/// The point `distance` beyond the projection of `p` on a polyline; `*piece` is the segment it is on,
/// advanced as needed.
Vector2d aim(const std::vector<Vector2d>& path, const Vector2d& p, double distance, std::size_t* piece) {
  const auto along = [&](std::size_t i) {
    const Vector2d d = path[i + 1] - path[i];
    return std::clamp((p - path[i]).dot(d) / d.squaredNorm(), 0.0, 1.0);
  };
  const auto passed = [&](std::size_t i) {
    return along(i) >= 1 || (path[i + 1] - p).norm() < 0.6 * distance;
  };
  while (*piece + 2 < path.size() && passed(*piece)) ++*piece;
  std::size_t i = *piece;
  Vector2d at = path[i] + along(i) * (path[i + 1] - path[i]);
  while (true) {
    const double left = (path[i + 1] - at).norm();
    if (left >= distance) return at + (path[i + 1] - at) * (distance / left);
    distance -= left;
    at = path[i + 1];
    if (++i + 1 >= path.size()) return at;
  }
}

}  // namespace

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

Route::Route(const Stance& start) { append(start); }

void Route::wait(double seconds) {
  const int steps = static_cast<int>(std::lround(seconds / kStep));
  for (int i = 0; i < steps; ++i) append(last());
}

void Route::turn(double yaw) {
  Stance s = last();
  const double goal = s.yaw + wrapped(yaw - s.yaw);
  double rate = 0;
  while (std::abs(goal - s.yaw) > 0.01 || std::abs(rate) > 0.2) {
    const double wanted = std::clamp(4 * (goal - s.yaw), -kTurnRate, kTurnRate);
    rate += std::clamp(wanted - rate, -kTurnAcceleration * kStep, kTurnAcceleration * kStep);
    s.yaw += rate * kStep;
    append(s);
  }
}

void Route::walk(const std::vector<Vector2d>& points, double speed) {
  std::vector<Vector2d> path{last().position};
  for (const Vector2d& p : points) {
    if ((p - path.back()).norm() > 0.05) path.push_back(p);
  }
  if (path.size() < 2) return;
  Stance s = last();
  std::size_t piece = 0;
  double v = 0, rate = 0;
  constexpr int kMaxSteps = 6000;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Vector2d target = aim(path, s.position, kLookAhead, &piece), to_end = path.back() - s.position;
    if (to_end.norm() < kArrived) break;
    const bool last_steps = piece + 2 == path.size() && to_end.norm() < 0.25;
    const Vector2d direction = last_steps ? to_end : Vector2d(target - s.position);
    const double error = wrapped(yaw_towards(direction) - s.yaw);
    const double wanted_rate = last_steps ? 0 : std::clamp(4.5 * error, -kTurnRate, kTurnRate);
    rate += std::clamp(wanted_rate - rate, -kTurnAcceleration * kStep, kTurnAcceleration * kStep);
    s.yaw += rate * kStep;
    // Slow in curves, at rest at the end.
    const double yaw_rate = last_steps ? 1 : std::pow(std::max(0.0, std::cos(error)), 2);
    const double wanted = std::min(speed * yaw_rate, std::sqrt(2 * kAcceleration * to_end.norm()));
    v += std::clamp(wanted - v, -2 * kAcceleration * kStep, kAcceleration * kStep);
    v = std::max(v, last_steps ? 0.08 : 0.0);
    const Vector2d step = last_steps ? Vector2d(direction.normalized()) : forward(s.yaw);
    s.position += std::min(v * kStep, to_end.norm()) * step;
    append(s);
  }
}

void Route::push_ahead(double distance, double speed) {
  const Stance start = last();
  const double seconds = 1.5 * distance / speed;
  for (double t = kStep; t <= seconds; t += kStep) {
    const double x = t / seconds;
    append({start.position + forward(start.yaw) * (distance * x * x * (3 - 2 * x)), start.yaw});
  }
}

void Route::note(Act act, double begin, const Pose& place) {
  episodes_.push_back({act, begin, end(), place});
}

Stance Route::at(double time) const {
  const double at = std::clamp(time / kStep, 0.0, static_cast<double>(samples_.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(at), samples_.size() - 1);
  const Stance &a = samples_[i], &b = samples_[std::min(i + 1, samples_.size() - 1)];
  const double f = at - static_cast<double>(i);
  return {a.position + f * (b.position - a.position), a.yaw + f * (b.yaw - a.yaw)};
}

double Route::speed(double time) const {
  constexpr double kSpan = 0.1;
  return (at(time + kSpan).position - at(time - kSpan).position).norm() / (2 * kSpan);
}

double Route::yaw_rate(double time) const {
  constexpr double kSpan = 0.1;
  return (at(time + kSpan).yaw - at(time - kSpan).yaw) / (2 * kSpan);
}

Route Route::shifted(const Vector2d& shift) const {
  Route result = *this;
  for (Stance& stance : result.samples_) stance.position += shift;
  return result;
}

void Route::cut(double time) {
  const auto keep = static_cast<std::size_t>(std::lround(time / kStep)) + 1;
  if (keep < samples_.size()) samples_.resize(keep);
  std::erase_if(episodes_, [&](const Episode& e) { return e.begin > time - 0.5 * kStep; });
}

}  // namespace stdc::simulation
