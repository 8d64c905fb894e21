#pragma once

#include <array>

#include "core/pose.hpp"
#include "simulation/people/skeleton.hpp"

namespace stdc::simulation {

/// A pose of the skeleton: world_from_bone for each bone. A bone's frame has its origin at its joint and the
/// axes of the rest pose.
struct BodyPose {
  std::array<Pose, kBones> bones;

  const Pose& operator[](Bone bone) const { return bones[index(bone)]; }
  Pose& operator[](Bone bone) { return bones[index(bone)]; }
  /// World position of a point, given in the rest pose [m], that moves with one bone.
  Eigen::Vector3d point(const Skeleton& skeleton, Bone bone, const Eigen::Vector3d& at_rest) const {
    return (*this)[bone] * (at_rest - skeleton.joint(bone));
  }
};

/// Places a bone at the end of its parent, rotated relative to it (in the axes of the rest pose).
void attach(const Skeleton& skeleton, Bone bone, const Eigen::Quaterniond& rotation, BodyPose& pose);

/// Two-bone inverse kinematics by the law of cosines: bends a limb so that the end of the lower bone reaches
/// `target`, or comes as close as it can. The upper bone's joint must be placed already.
/// @param bend_towards  direction in which the middle joint bends, world
/// @param hinge         axis about which the lower bone flexes, right-handed, in the axes of the rest pose
void reach(const Skeleton& skeleton, Bone upper, Bone lower, const Eigen::Vector3d& target,
           const Eigen::Vector3d& bend_towards, const Eigen::Vector3d& hinge, BodyPose& pose);

}  // namespace stdc::simulation
