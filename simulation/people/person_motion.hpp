#pragma once

#include <optional>

#include "simulation/people/body_pose.hpp"
#include "simulation/people/footsteps.hpp"
#include "simulation/people/route.hpp"

namespace stdc {

/// How a person moves who follows a route: the legs step so that planted feet stay where they are, hips and
/// trunk turn with the stride, arms swing against the legs, and episodes of the route are acted out.
class PersonMotion {
 public:
  /// @param seed  of the small movements that make people differ
  PersonMotion(const BodyPlan& plan, Route route, std::uint64_t seed);

  BodyPose pose(double time) const;
  const Route& route() const { return route_; }
  const BodyPlan& plan() const { return plan_; }
  const Footsteps& footsteps() const { return footsteps_; }
  /// Where the box is that this person carries, sets down or picks up: the middle of its lower face.
  Pose held_box(double time) const;

 private:
  struct Doing {
    Act act = Act::idle;
    double amount = 0;   ///< how far it is acted out, 0..1; place, pick: how far the box is down
    double holding = 0;  ///< how firmly the hands are at the box
    Pose place;
  };
  /// Where a wrist wants to be, and how much the arm follows instead of swinging.
  struct Grasp {
    Eigen::Vector3d wrist;
    double share = 1;
  };
  Doing doing(double time) const;
  Pose pelvis(double time, const Stance& body, const Doing& now) const;
  double standing_height(double time, const Stance& body) const;
  void pose_trunk(double time, const Doing& now, double stride, BodyPose& pose) const;
  void pose_legs(double time, BodyPose& pose) const;
  void pose_arms(double time, const Doing& now, double stride, BodyPose& pose) const;
  std::optional<Grasp> grasp(bool left, double time, const Doing& now, const BodyPose& pose) const;
  void move_arm(bool left, const Grasp& grasp, const Eigen::Vector3d& elbow_towards, BodyPose& pose) const;

  BodyPlan plan_;
  Route route_;
  Footsteps footsteps_;
  double phase_[4];
};

// An episode `place` begins with the box in the hands, which let go of it after kMovingBox and are back after
// kHandling; in an episode `pick` the same goes backward.
constexpr double kMovingBox = 1.3, kHandling = 2.0;  // [s]
constexpr double kBoxSize[3] = {0.38, 0.29, 0.26};   ///< width between the hands, depth, height [m]

}  // namespace stdc
