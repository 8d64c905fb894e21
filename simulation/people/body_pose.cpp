#include "simulation/people/body_pose.hpp"

#include <algorithm>
#include <cmath>

namespace stdc::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Right-handed axes: the first along `direction`, the second as close to `side` as possible.
Matrix3d axes(const Vector3d& direction, const Vector3d& side) {
  Matrix3d m;
  m.col(0) = direction.normalized();
  m.col(1) = (side - m.col(0) * m.col(0).dot(side)).normalized();
  m.col(2) = m.col(0).cross(m.col(1));
  return m;
}

}  // namespace

void attach(const Skeleton& skeleton, Bone bone, const Eigen::Quaterniond& rotation, BodyPose& pose) {
  const Pose& carrier = pose[parent(bone)];
  pose[bone] =
      Pose(carrier.rotation * rotation, carrier * (skeleton.joint(bone) - skeleton.joint(parent(bone))));
}

void reach(const Skeleton& skeleton, Bone upper, Bone lower, const Vector3d& target,
           const Vector3d& bend_towards, const Vector3d& hinge, BodyPose& pose) {
  const double a = skeleton.length(upper), b = (skeleton.end(lower) - skeleton.joint(lower)).norm();
  const Vector3d root = pose[upper].translation, to_target = target - root;
  const double distance = std::clamp(to_target.norm(), std::abs(a - b) + 0.02, (a + b) * 0.9995);
  const Vector3d direction = to_target.normalized();
  const Vector3d aside = (bend_towards - direction * direction.dot(bend_towards)).normalized();
  const double along = (a * a + distance * distance - b * b) / (2 * distance);
  const double out = std::sqrt(std::max(0.0, a * a - along * along));
  const Vector3d middle = root + along * direction + out * aside;
  const Vector3d tip = root + distance * direction;
  const Vector3d world_hinge = aside.cross(direction);
  const auto rotation = [&](Bone bone, const Vector3d& from, const Vector3d& to) {
    const Matrix3d rest = axes(skeleton.end(bone) - skeleton.joint(bone), hinge);
    return Eigen::Quaterniond(axes(to - from, world_hinge) * rest.transpose());
  };
  pose[upper] = Pose(rotation(upper, root, middle), root);
  pose[lower] = Pose(rotation(lower, middle, tip), middle);
}

}  // namespace stdc::simulation
