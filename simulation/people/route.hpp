#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/pose.hpp"

namespace stdc::simulation {

/// What a person does at a place or while walking.
enum class Act { idle, talk, phone, sit, carry, place, pick, push, tap };

/// Position and heading of a person on the floor. At yaw 0 the person faces -y.
struct Stance {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m]
  double yaw = 0;                                      ///< [rad], not wrapped
};

inline Eigen::Vector2d forward(double yaw) { return {std::sin(yaw), -std::cos(yaw)}; }
/// Yaw of a person who faces along `direction`.
inline double yaw_towards(const Eigen::Vector2d& direction) {
  return std::atan2(direction.x(), -direction.y());
}

/// An activity with its time span.
struct Episode {
  Act act = Act::idle;
  double begin = 0, end = 0;  ///< [s]
  Pose place;                 ///< sit: of the chair; place, pick: of the box when put down
};

/// The trajectory of one person on the floor, appended piece by piece, with activities. Starts at time 0.
class Route {
 public:
  static constexpr double kStep = 0.01;  ///< between samples [s]

  explicit Route(const Stance& start);

  /// Walks through the points: turns on the spot first if needed, speeds up, rounds the corners, and slows
  /// down to stop at the last one.
  void walk(const std::vector<Eigen::Vector2d>& points, double speed);
  void turn(double yaw);
  void wait(double seconds);
  /// Moves straight ahead with smooth acceleration, as when pushing something.
  void push_ahead(double distance, double speed);
  /// Adds an activity from `begin` to the present end.
  void note(Act act, double begin, const Pose& place = {});

  /// Adds an activity from `begin` to `end`.
  void note_span(Act act, double begin, double end) { episodes_.push_back({act, begin, end, {}}); }

  double end() const { return kStep * static_cast<double>(samples_.size() - 1); }
  const Stance& last() const { return samples_.back(); }
  /// Before the start and after the end the person stands still.
  Stance at(double time) const;
  /// [m/s], [rad/s]
  double speed(double time) const;
  double yaw_rate(double time) const;
  const std::vector<Episode>& episodes() const { return episodes_; }
  /// The same route elsewhere. Places of episodes stay where they are.
  Route shifted(const Eigen::Vector2d& shift) const;
  /// Removes all after `time`, with the episodes that begin later.
  void cut(double time);

 private:
  void append(const Stance& stance) { samples_.push_back(stance); }

  std::vector<Stance> samples_;
  std::vector<Episode> episodes_;
};

/// `angle` wrapped to [-pi, pi].
double wrapped(double angle);

}  // namespace stdc::simulation
