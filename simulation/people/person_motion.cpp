#include "simulation/people/person_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "simulation/scene/furniture.hpp"
#include "simulation/scene/motion_curves.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kBlend = 0.7;    // time to begin or end a gesture [s]
constexpr double kSitting = 1.5;  // time to sit down or get up [s]
constexpr double kPlacing = 1.3;  // time to put a box down [s]

}  // namespace

PersonMotion::PersonMotion(const Skeleton& skeleton, Route route, std::uint64_t seed)
    : skeleton_(skeleton), route_(std::move(route)), footsteps_(skeleton_, route_, route_.end() - 1.5) {
  Random random(seed, 51);
  for (double& phase : phase_) phase = random.uniform(0, 2 * std::numbers::pi);
}

PersonMotion::Action PersonMotion::action_at(double time) const {
  Action now;
  for (const Episode& e : route_.episodes()) {
    if (time < e.begin || time > e.end) continue;
    const double since = time - e.begin, left = e.end - time;
    now = {e.act, 0, 0, e.place};
    switch (e.act) {
      case Act::carry:
        now.amount = now.holding = 1;
        break;
      case Act::place:
        now.amount = smooth(since / kMovingBox);
        now.holding = smooth(left / (kHandling - kMovingBox));
        break;
      case Act::pick:
        now.amount = smooth(left / kMovingBox);
        now.holding = smooth(since / (kHandling - kMovingBox));
        break;
      default: {
        const double blend = e.act == Act::sit ? kSitting : kBlend;
        now.amount = std::min(smooth(since / blend), smooth(left / blend));
      }
    }
  }
  return now;
}

double PersonMotion::standing_height(double time, const Stance& body) const {
  const double reach = 0.992 * (skeleton_.length(Bone::left_thigh) + skeleton_.length(Bone::left_shin));
  const double above_hip = skeleton_.joint(Bone::pelvis).z() - skeleton_.joint(Bone::left_thigh).z();
  double height = skeleton_.joint(Bone::pelvis).z() - 0.012;
  const Quaterniond yaw = about_z(body.yaw);
  for (const int side : {Footsteps::kLeft, Footsteps::kRight}) {
    const Bone thigh = side == Footsteps::kLeft ? Bone::left_thigh : Bone::right_thigh;
    const Vector3d hip = yaw * (skeleton_.joint(thigh) - skeleton_.joint(Bone::pelvis));
    const Vector3d ankle = footsteps_.foot(side, time).world_from_foot.translation;
    const double aside = (ankle.head<2>() - body.position - hip.head<2>()).norm();
    const double highest = ankle.z() + std::sqrt(std::max(0.04, reach * reach - aside * aside)) + above_hip;
    height = soft_min(height, highest, 0.03);
  }
  return height;
}

Pose PersonMotion::pelvis(double time, const Stance& body, const Action& now) const {
  double height = 0;
  for (const double shift : {-0.06, -0.03, 0.0, 0.03, 0.06}) {
    height += 0.2 * standing_height(time + shift, route_.at(time + shift));
  }
  const double stride = footsteps_.stride(time, body.yaw), balance = footsteps_.balance(time);
  const Eigen::Vector2d left(std::cos(body.yaw), std::sin(body.yaw));
  const Eigen::Vector2d at = body.position - left * (0.018 * balance + 0.008 * wave(time, 5.3, phase_[0]));
  // The hip on the side of the front foot goes forward, that of the lifted foot drops.
  const Quaterniond rotation = about_z(body.yaw - 0.14 * stride / 0.6) * about_y(0.045 * balance);
  Pose pose(rotation, Vector3d(at.x(), at.y(), height));
  if (now.act == Act::sit) {
    const Vector3d seat = now.place * Vector3d(0, 0.05, kSeatHeight + 0.085 * skeleton_.scale());
    const double a = now.amount;
    // Backward first, then down.
    pose.translation.head<2>() += (seat - pose.translation).head<2>() * smooth(1.15 * a);
    pose.translation.z() += (seat.z() - pose.translation.z()) * a;
    pose.rotation = pose.rotation * about_x(0.35 * std::sin(std::numbers::pi * a) - 0.12 * a);
  }
  return pose;
}

void PersonMotion::pose_trunk(double time, const Action& now, double stride, BodyPose& pose) const {
  const double twist = 0.30 * stride / 0.6, breath = 0.01 * wave(time, 3.6, phase_[1]);
  const double pace = route_.speed(time);
  double lean = 0.05 * std::min(1.0, pace) + breath;
  if (now.act == Act::sit) lean += 0.45 * std::sin(std::numbers::pi * now.amount) + 0.05 * now.amount;
  if (now.act == Act::carry) lean -= 0.05 * now.amount;
  if (now.act == Act::place || now.act == Act::pick) lean += 0.3 * now.amount * now.holding;
  if (now.act == Act::push) lean += 0.22 * now.amount;
  attach(skeleton_, Bone::spine, about_x(0.5 * lean) * about_z(0.5 * twist), pose);
  attach(skeleton_, Bone::chest,
         about_x(0.5 * lean) * about_z(0.5 * twist) * about_y(0.02 * wave(time, 7.1, phase_[2])), pose);
  const double look =
      0.3 * wave(time, 6.4, phase_[3]) * (pace < 0.1 ? 1.5 : 0.5) + 0.25 * route_.yaw_rate(time + 0.25) / 2;
  const double nod = 0.05 + 0.06 * wave(time, 4.7, phase_[0]) +
                     (now.act == Act::place || now.act == Act::pick ? 0.3 * now.amount : 0);
  attach(skeleton_, Bone::neck, about_x(0.4 * nod - 0.4 * lean) * about_z(0.4 * look - 0.5 * twist), pose);
  attach(skeleton_, Bone::head, about_x(0.6 * nod - 0.4 * lean) * about_z(0.6 * look), pose);
}

void PersonMotion::pose_legs(double time, BodyPose& pose) const {
  for (const int side : {Footsteps::kLeft, Footsteps::kRight}) {
    const bool is_left = side == Footsteps::kLeft;
    const Bone thigh = is_left ? Bone::left_thigh : Bone::right_thigh,
               shin = static_cast<Bone>(index(thigh) + 1);
    const Bone foot = static_cast<Bone>(index(thigh) + 2);
    const Pose world_from_foot = footsteps_.foot(side, time).world_from_foot;
    attach(skeleton_, thigh, Quaterniond::Identity(), pose);
    const Vector3d ahead_hip = pose[Bone::pelvis].rotation * Vector3d(is_left ? 0.12 : -0.12, -1, 0);
    const Vector3d ahead_foot = world_from_foot.rotation * Vector3d(0, -1, 0);
    const Vector3d ahead = ahead_hip.normalized() + ahead_foot.normalized() + Vector3d(0, 0, 0.5);
    reach(skeleton_, thigh, shin, world_from_foot.translation, ahead, Vector3d::UnitX(), pose);
    // The shoe stays on its footstep unless the leg is too short to reach it.
    const Vector3d ankle = pose[shin] * (skeleton_.end(shin) - skeleton_.joint(shin));
    pose[foot] = Pose(world_from_foot.rotation, ankle);
  }
}

BodyPose PersonMotion::pose(double time) const {
  const Stance body = route_.at(time);
  const Action now = action_at(time);
  const double stride = footsteps_.stride(time, body.yaw);
  BodyPose pose;
  pose[Bone::pelvis] = pelvis(time, body, now);
  pose_trunk(time, now, stride, pose);
  pose_legs(time, pose);
  pose_arms(time, now, stride, pose);
  return pose;
}

}  // namespace stdc::simulation
