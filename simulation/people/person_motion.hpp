#pragma once

#include <optional>

#include "simulation/people/body_pose.hpp"
#include "simulation/people/footsteps.hpp"
#include "simulation/people/route.hpp"

namespace stdc::simulation {

/// The body motion of a person who follows a route: planted feet do not slide, hips and trunk rotate with the
/// stride, arms swing against the legs, and the activities of the route are shown.
class PersonMotion {
 public:
  /// @param seed  of the small motions in which people differ
  PersonMotion(const Skeleton& skeleton, Route route, std::uint64_t seed);

  BodyPose pose(double time) const;
  const Route& route() const { return route_; }
  const Skeleton& skeleton() const { return skeleton_; }
  const Footsteps& footsteps() const { return footsteps_; }
  /// world_from_box of the box that this person carries, puts down or picks up; its origin is the centre of
  /// the bottom.
  Pose held_box(double time) const;

 private:
  struct Action {
    Act act = Act::idle;
    double amount = 0;   ///< 0..1: how far the activity is taken up; place, pick: how far the box is put down
    double holding = 0;  ///< 0..1: how far the hands are on the box
    Pose place;
  };
  /// Target of a wrist, and the share with which the arm follows it instead of swinging.
  struct Grasp {
    Eigen::Vector3d wrist;
    double share = 1;
  };
  Action action_at(double time) const;
  Pose pelvis(double time, const Stance& body, const Action& now) const;
  double standing_height(double time, const Stance& body) const;
  void pose_trunk(double time, const Action& now, double stride, BodyPose& pose) const;
  void pose_legs(double time, BodyPose& pose) const;
  void pose_arms(double time, const Action& now, double stride, BodyPose& pose) const;
  std::optional<Grasp> grasp(bool left, double time, const Action& now, const BodyPose& pose) const;
  void move_arm(bool left, const Grasp& grasp, const Eigen::Vector3d& elbow_towards, BodyPose& pose) const;

  Skeleton skeleton_;
  Route route_;
  Footsteps footsteps_;
  double phase_[4];
};

// An episode `place` begins with the box in the hands; they let go of it after kMovingBox and are back at the
// side after kHandling. An episode `pick` is the reverse.
constexpr double kMovingBox = 1.3, kHandling = 2.0;  // [s]
constexpr double kBoxSize[3] = {0.38, 0.29, 0.26};   ///< width between the hands, depth, height [m]

}  // namespace stdc::simulation
