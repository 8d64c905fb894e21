#pragma once

#include <array>
#include <vector>

#include "simulation/people/route.hpp"
#include "simulation/people/skeleton.hpp"

namespace stdc::simulation {

/// One foot at one moment.
struct FootState {
  Pose world_from_foot;  ///< of the foot bone: origin in the ankle
  bool planted = true;   ///< it bears weight: sole, heel or ball rests on the floor
};

/// The footsteps of a person who follows a route. A planted foot does not slide: steps are planned ahead, and
/// each foot goes to where it will be below the hip in the middle of its next stance. The foot rolls from
/// heel to ball.
class Footsteps {
 public:
  static constexpr int kLeft = 0, kRight = 1;

  /// Plans until `end` [s].
  Footsteps(const Skeleton& skeleton, const Route& route, double end);

  FootState foot(int side, double time) const;
  /// How far the left foot is ahead of the right, in the direction the person faces [m].
  double stride(double time, double yaw) const;
  /// -1: all weight is on the left foot, 1: on the right.
  double balance(double time) const;

 private:
  struct Step {
    double lift = 0, land = 0;  ///< [s]
    Stance from, to;
  };
  Stance planted_for(int side, const Stance& body) const;
  Stance stance(int side, double time, double* swing, double* pitch) const;
  void plan_steps(const Route& route, double end);

  double scale_, half_width_;
  Eigen::Vector3d ankle_;  ///< relative to the foot's position on the floor
  std::array<Stance, 2> start_;
  std::array<std::vector<Step>, 2> steps_;
};

}  // namespace stdc::simulation
