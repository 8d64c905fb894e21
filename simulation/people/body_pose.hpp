#pragma once

#include <array>

#include "core/pose.hpp"
#include "simulation/people/body_plan.hpp"

namespace stdc {

/// Where every bone of a person is: world_from_bone; a bone's own frame has its origin in its joint and the
/// axes of the body at rest.
struct BodyPose {
  std::array<Pose, kBones> bones;

  const Pose& operator[](Bone bone) const { return bones[index(bone)]; }
  Pose& operator[](Bone bone) { return bones[index(bone)]; }
  /// Where a point of the body at rest [m] goes if it is fixed to one bone.
  Eigen::Vector3d point(const BodyPlan& plan, Bone bone, const Eigen::Vector3d& at_rest) const {
    return (*this)[bone] * (at_rest - plan.joint(bone));
  }
};

/// Puts a bone at the end of its parent, turned against it by `turn` (in the body's rest axes).
void attach(const BodyPlan& plan, Bone bone, const Eigen::Quaterniond& turn, BodyPose& pose);

/// Bends a limb of two bones so that the end of the lower one comes to `target` (as near as the limb
/// reaches). The upper bone's joint must be in its place already.
/// @param bend_towards  direction into which the middle joint bends, world
/// @param hinge         the axis of the middle joint in the body's rest axes, right-handed about which the
/// lower
///                      bone flexes
/// Plain two-bone inverse kinematics by the law of cosines.
void reach(const BodyPlan& plan, Bone upper, Bone lower, const Eigen::Vector3d& target,
           const Eigen::Vector3d& bend_towards, const Eigen::Vector3d& hinge, BodyPose& pose);

}  // namespace stdc
