#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/pose.hpp"

namespace stdc {

/// What a person does besides walking.
enum class Act { idle, talk, phone, sit, carry, place, pick, push };

/// Where a person's body is on the floor and which way it faces. At yaw 0 it faces -y.
struct Stance {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m]
  double yaw = 0;                                      ///< [rad], not wrapped
};

inline Eigen::Vector2d forward(double yaw) { return {std::sin(yaw), -std::cos(yaw)}; }
/// The yaw of somebody who looks along `direction`.
inline double yaw_towards(const Eigen::Vector2d& direction) {
  return std::atan2(direction.x(), -direction.y());
}

/// A stretch of time with something to do.
struct Episode {
  Act act = Act::idle;
  double begin = 0, end = 0;  ///< [s]
  Pose place;                 ///< sit: of the chair; place, pick: of the box set down
};

/// The way of one person over the floor, laid down piece by piece, and what is done when. Time starts at 0.
class Route {
 public:
  static constexpr double kStep = 0.01;  ///< between samples [s]

  explicit Route(const Stance& start);

  /// Walks through the points: turns on the spot first if it must, speeds up, follows the corners in curves,
  /// and slows down to stop at the last.
  void walk(const std::vector<Eigen::Vector2d>& points, double speed);
  void turn(double yaw);
  void wait(double seconds);
  /// Moves straight ahead as one who pushes something: softly, facing the same way.
  void push_ahead(double distance, double speed);
  /// Notes that from `begin` until now this was done.
  void note(Act act, double begin, const Pose& place = {});

  double end() const { return kStep * static_cast<double>(samples_.size() - 1); }
  const Stance& last() const { return samples_.back(); }
  /// Before the start and after the end it stands still.
  Stance at(double time) const;
  /// [m/s], [rad/s]
  double speed(double time) const;
  double turning(double time) const;
  const std::vector<Episode>& episodes() const { return episodes_; }
  /// Forgets what comes after `time`; episodes that begin later too.
  void cut(double time);

 private:
  void append(const Stance& stance) { samples_.push_back(stance); }

  std::vector<Stance> samples_;
  std::vector<Episode> episodes_;
};

/// `angle` wrapped to [-pi, pi].
double wrapped(double angle);

}  // namespace stdc
