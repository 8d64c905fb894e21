// Motion of the arms: swing, gesture, hold and push.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/people/person_motion.hpp"
#include "simulation/scene/furniture.hpp"
#include "simulation/scene/motion_curves.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3d;

const Vector3d kUp = Vector3d::UnitZ();

struct ArmBones {
  explicit ArmBones(bool left)
      : upper(left ? Bone::left_upper_arm : Bone::right_upper_arm),
        lower(left ? Bone::left_forearm : Bone::right_forearm),
        hand(left ? Bone::left_hand : Bone::right_hand) {}
  Bone upper, lower, hand;
};

}  // namespace

void PersonMotion::move_arm(bool left, const Grasp& grasp, const Vector3d& elbow_towards,
                            BodyPose& pose) const {
  const ArmBones arm(left);
  const Eigen::Quaterniond upper_before = pose[arm.upper].rotation, lower_before = pose[arm.lower].rotation;
  reach(skeleton_, arm.upper, arm.lower, grasp.wrist, elbow_towards, -Vector3d::UnitX(), pose);
  pose[arm.upper].rotation = upper_before.slerp(grasp.share, pose[arm.upper].rotation);
  pose[arm.lower] = Pose(lower_before.slerp(grasp.share, pose[arm.lower].rotation),
                         pose[arm.upper] * (skeleton_.end(arm.upper) - skeleton_.joint(arm.upper)));
  attach(skeleton_, arm.hand, Eigen::Quaterniond::Identity(), pose);
}

Pose PersonMotion::held_box(double time) const {
  const Stance body = route_.at(time);
  const Action now = action_at(time);
  const double bob = 0.3 * (pelvis(time, body, {}).translation.z() - skeleton_.joint(Bone::pelvis).z());
  const Vector3d ahead(forward(body.yaw).x(), forward(body.yaw).y(), 0);
  const Vector3d at =
      Vector3d(body.position.x(), body.position.y(), 0.98 * skeleton_.scale() + bob) + 0.36 * ahead;
  const Pose held(about_z(body.yaw), at);
  if (now.act != Act::place && now.act != Act::pick) return held;
  const double a = now.amount;
  const Vector3d lifted(0, 0, 0.05 * std::sin(std::numbers::pi * a));
  return {held.rotation.slerp(a, now.place.rotation),
          held.translation + a * (now.place.translation - held.translation) + lifted};
}

std::optional<PersonMotion::Grasp> PersonMotion::grasp(bool left, double time, const Action& now,
                                                       const BodyPose& pose) const {
  const double out = left ? 1 : -1;
  const Pose& chest = pose[Bone::chest];
  const Vector3d ahead = chest.rotation * Vector3d(0, -1, 0), to_left = chest.rotation * Vector3d(1, 0, 0);
  switch (now.act) {
    case Act::idle:
      break;
    case Act::sit: {  // on the thighs
      const Bone thigh = left ? Bone::left_thigh : Bone::right_thigh;
      const Vector3d hip = pose[thigh].translation, knee = pose.point(skeleton_, thigh, skeleton_.end(thigh));
      return Grasp{hip + 0.62 * (knee - hip) + 0.11 * kUp - 0.05 * ahead, smooth(2 * now.amount - 1)};
    }
    case Act::phone: {  // the right hand reaches from before the shoulder up to the ear
      if (left) break;
      const Vector3d shoulder = pose[Bone::right_upper_arm].translation;
      return Grasp{shoulder + 0.06 * kUp + 0.15 * ahead - 0.01 * to_left, now.amount};
    }
    case Act::talk: {
      const double beat = wave(time, 1.7, phase_[left ? 0 : 3]) * (0.6 + 0.4 * wave(time, 4.1, phase_[2]));
      const Vector3d front =
          chest.translation + 0.33 * ahead + out * 0.17 * to_left + (0.02 + 0.09 * beat) * kUp;
      return Grasp{front, now.amount * (left ? 0.9 : smooth(0.6 + 0.6 * wave(time, 5, phase_[1])))};
    }
    case Act::carry:
    case Act::place:
    case Act::pick: {
      const Vector3d side = held_box(time) * Vector3d(out * (0.5 * kBoxSize[0] + 0.035), 0.02, 0.09);
      return Grasp{side - 0.10 * ahead, now.holding};
    }
    case Act::tap: {  // both palms up before the chest
      const Vector3d front = chest.translation + 0.38 * ahead + out * 0.09 * to_left - 0.02 * kUp;
      return Grasp{front, now.amount};
    }
    case Act::push: {  // on the back rest
      const Eigen::Vector2d direction = forward(route_.at(time).yaw);
      Vector3d rest = pose[Bone::pelvis].translation + 0.37 * Vector3d(direction.x(), direction.y(), 0) +
                      out * 0.16 * to_left;
      rest.z() = kSeatHeight + 0.61;
      return Grasp{rest, now.amount};
    }
  }
  return std::nullopt;
}

void PersonMotion::pose_arms(double time, const Action& now, double stride, BodyPose& pose) const {
  const double pace = std::min(1.0, route_.speed(time)), swing = 0.44 * stride / 0.6;
  for (const bool left : {true, false}) {
    const double out = left ? 1 : -1;
    const ArmBones arm(left);
    // The arm of one side goes forward (negative about x) with the foot of the other.
    const double back = out * swing + 0.04 * wave(time, 5.9, phase_[left ? 1 : 2]);
    attach(skeleton_, arm.upper, about_x(back) * about_y(out * 0.30), pose);
    attach(skeleton_, arm.lower, about_x(-0.2 - 0.1 * pace - 0.45 * std::max(0.0, -back)), pose);
    attach(skeleton_, arm.hand, Eigen::Quaterniond::Identity(), pose);
    if (const std::optional<Grasp> wanted = grasp(left, time, now, pose)) {
      const Eigen::Matrix3d chest = pose[Bone::chest].rotation_matrix();
      move_arm(left, *wanted, -kUp + 0.4 * out * chest.col(0) + 0.3 * chest.col(1), pose);
    }
  }
}

}  // namespace stdc::simulation
