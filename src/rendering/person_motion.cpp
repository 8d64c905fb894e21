#include "rendering/person_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "rendering/furniture.hpp"

namespace stdc {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kBlend = 0.7;    // time to take up or give up a gesture [s]
constexpr double kSitting = 1.5;  // time to sit down or get up [s]
constexpr double kPlacing = 1.3;  // time to set a box down [s]

double smooth(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

double soft_min(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - 0.25 * k * h * h;
}

Quaterniond about(const Vector3d& axis, double radians) {
  return Quaterniond(Eigen::AngleAxisd(radians, axis));
}
Quaterniond about_x(double radians) { return about(Vector3d::UnitX(), radians); }
Quaterniond about_y(double radians) { return about(Vector3d::UnitY(), radians); }
Quaterniond about_z(double radians) { return about(Vector3d::UnitZ(), radians); }

double wave(double time, double period, double phase) {
  return std::sin(2 * std::numbers::pi * time / period + phase);
}

}  // namespace

PersonMotion::PersonMotion(const BodyPlan& plan, Route route, std::uint64_t seed)
    : plan_(plan), route_(std::move(route)), footsteps_(plan_, route_, route_.end() - 1.5) {
  Random random(seed, 51);
  for (double& phase : phase_) phase = random.uniform(0, 2 * std::numbers::pi);
}

PersonMotion::Doing PersonMotion::doing(double time) const {
  Doing now;
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
  const double reach = 0.992 * (plan_.length(Bone::left_thigh) + plan_.length(Bone::left_shin));
  const double above_hip = plan_.joint(Bone::pelvis).z() - plan_.joint(Bone::left_thigh).z();
  double height = plan_.joint(Bone::pelvis).z() - 0.012;
  const Quaterniond yaw = about_z(body.yaw);
  for (const int side : {Footsteps::kLeft, Footsteps::kRight}) {
    const Bone thigh = side == Footsteps::kLeft ? Bone::left_thigh : Bone::right_thigh;
    const Vector3d hip = yaw * (plan_.joint(thigh) - plan_.joint(Bone::pelvis));
    const Vector3d ankle = footsteps_.foot(side, time).world_from_foot.translation;
    const double aside = (ankle.head<2>() - body.position - hip.head<2>()).norm();
    const double highest = ankle.z() + std::sqrt(std::max(0.04, reach * reach - aside * aside)) + above_hip;
    height = soft_min(height, highest, 0.03);
  }
  return height;
}

Pose PersonMotion::pelvis(double time, const Stance& body, const Doing& now) const {
  double height = 0;
  for (const double shift : {-0.06, -0.03, 0.0, 0.03, 0.06}) {
    height += 0.2 * standing_height(time + shift, route_.at(time + shift));
  }
  const double stride = footsteps_.stride(time, body.yaw), balance = footsteps_.balance(time);
  const Eigen::Vector2d left(std::cos(body.yaw), std::sin(body.yaw));
  const Eigen::Vector2d at = body.position - left * (0.018 * balance + 0.008 * wave(time, 5.3, phase_[0]));
  // The hip of the foot in front goes ahead, the one of the free foot drops.
  const Quaterniond turn = about_z(body.yaw - 0.14 * stride / 0.6) * about_y(0.045 * balance);
  Pose pose(turn, Vector3d(at.x(), at.y(), height));
  if (now.act == Act::sit) {
    const Vector3d seat = now.place * Vector3d(0, 0.05, kSeatHeight + 0.085 * plan_.scale());
    const double a = now.amount;
    // Backward first, then down.
    pose.translation.head<2>() += (seat - pose.translation).head<2>() * smooth(1.15 * a);
    pose.translation.z() += (seat.z() - pose.translation.z()) * a;
    pose.rotation = pose.rotation * about_x(0.35 * std::sin(std::numbers::pi * a) - 0.12 * a);
  }
  return pose;
}

void PersonMotion::pose_trunk(double time, const Doing& now, double stride, BodyPose& pose) const {
  const double twist = 0.30 * stride / 0.6, breath = 0.01 * wave(time, 3.6, phase_[1]);
  const double pace = route_.speed(time);
  double lean = 0.05 * std::min(1.0, pace) + breath;
  if (now.act == Act::sit) lean += 0.45 * std::sin(std::numbers::pi * now.amount) + 0.05 * now.amount;
  if (now.act == Act::carry) lean -= 0.05 * now.amount;
  if (now.act == Act::place || now.act == Act::pick) lean += 0.3 * now.amount * now.holding;
  if (now.act == Act::push) lean += 0.22 * now.amount;
  attach(plan_, Bone::spine, about_x(0.5 * lean) * about_z(0.5 * twist), pose);
  attach(plan_, Bone::chest,
         about_x(0.5 * lean) * about_z(0.5 * twist) * about_y(0.02 * wave(time, 7.1, phase_[2])), pose);
  const double look =
      0.3 * wave(time, 6.4, phase_[3]) * (pace < 0.1 ? 1.5 : 0.5) + 0.25 * route_.turning(time + 0.25) / 2;
  const double nod = 0.05 + 0.06 * wave(time, 4.7, phase_[0]) +
                     (now.act == Act::place || now.act == Act::pick ? 0.3 * now.amount : 0);
  attach(plan_, Bone::neck, about_x(0.4 * nod - 0.4 * lean) * about_z(0.4 * look - 0.5 * twist), pose);
  attach(plan_, Bone::head, about_x(0.6 * nod - 0.4 * lean) * about_z(0.6 * look), pose);
}

void PersonMotion::pose_legs(double time, BodyPose& pose) const {
  for (const int side : {Footsteps::kLeft, Footsteps::kRight}) {
    const bool is_left = side == Footsteps::kLeft;
    const Bone thigh = is_left ? Bone::left_thigh : Bone::right_thigh,
               shin = static_cast<Bone>(index(thigh) + 1);
    const Bone foot = static_cast<Bone>(index(thigh) + 2);
    const Pose world_from_foot = footsteps_.foot(side, time).world_from_foot;
    attach(plan_, thigh, Quaterniond::Identity(), pose);
    const Vector3d ahead_hip = pose[Bone::pelvis].rotation * Vector3d(is_left ? 0.12 : -0.12, -1, 0);
    const Vector3d ahead_foot = world_from_foot.rotation * Vector3d(0, -1, 0);
    const Vector3d ahead = ahead_hip.normalized() + ahead_foot.normalized() + Vector3d(0, 0, 0.5);
    reach(plan_, thigh, shin, world_from_foot.translation, ahead, Vector3d::UnitX(), pose);
    // The shoe stays where the steps put it; only if the leg is too short does it follow the leg.
    const Vector3d ankle = pose[shin] * (plan_.end(shin) - plan_.joint(shin));
    pose[foot] = Pose(world_from_foot.rotation, ankle);
  }
}

void PersonMotion::move_arm(bool left, const Vector3d& wrist, const Vector3d& elbow_towards, double share,
                            BodyPose& pose) const {
  const Bone upper = left ? Bone::left_upper_arm : Bone::right_upper_arm,
             lower = static_cast<Bone>(index(upper) + 1);
  const Quaterniond upper_before = pose[upper].rotation, lower_before = pose[lower].rotation;
  reach(plan_, upper, lower, wrist, elbow_towards, -Vector3d::UnitX(), pose);
  pose[upper].rotation = upper_before.slerp(share, pose[upper].rotation);
  pose[lower] = Pose(lower_before.slerp(share, pose[lower].rotation),
                     pose[upper] * (plan_.end(upper) - plan_.joint(upper)));
  attach(plan_, static_cast<Bone>(index(upper) + 2), Quaterniond::Identity(), pose);
}

Pose PersonMotion::held_box(double time) const {
  const Stance body = route_.at(time);
  const Doing now = doing(time);
  const double bob = 0.3 * (pelvis(time, body, {}).translation.z() - plan_.joint(Bone::pelvis).z());
  const Vector3d ahead(forward(body.yaw).x(), forward(body.yaw).y(), 0);
  const Vector3d at =
      Vector3d(body.position.x(), body.position.y(), 0.98 * plan_.scale() + bob) + 0.36 * ahead;
  Pose pose(about_z(body.yaw), at);
  if (now.act == Act::place || now.act == Act::pick) {
    const double a = now.amount;
    const Vector3d lifted(0, 0, 0.05 * std::sin(std::numbers::pi * a));
    pose = Pose(pose.rotation.slerp(a, now.place.rotation),
                pose.translation + a * (now.place.translation - pose.translation) + lifted);
  }
  return pose;
}

void PersonMotion::pose_arms(double time, const Doing& now, double stride, BodyPose& pose) const {
  const double pace = std::min(1.0, route_.speed(time));
  const double swing = 0.44 * stride / 0.6;
  const Vector3d up(0, 0, 1), ahead = pose[Bone::chest].rotation * Vector3d(0, -1, 0);
  const Vector3d to_left = pose[Bone::chest].rotation * Vector3d(1, 0, 0);
  for (const bool left : {true, false}) {
    const double out = left ? 1 : -1;
    const Bone upper = left ? Bone::left_upper_arm : Bone::right_upper_arm,
               lower = static_cast<Bone>(index(upper) + 1);
    // The arm of one side goes forward (negative about x) with the foot of the other.
    const double back = out * swing + 0.04 * wave(time, 5.9, phase_[left ? 1 : 2]);
    attach(plan_, upper, about_x(back) * about_y(out * 0.30), pose);
    attach(plan_, lower, about_x(-0.2 - 0.1 * pace - 0.45 * std::max(0.0, -back)), pose);
    attach(plan_, static_cast<Bone>(index(upper) + 2), Quaterniond::Identity(), pose);
    const Vector3d elbow_out = -up + 0.4 * out * to_left - 0.3 * ahead;
    switch (now.act) {
      case Act::sit: {
        const Bone thigh = left ? Bone::left_thigh : Bone::right_thigh;
        const Vector3d knee = pose[thigh] * (plan_.end(thigh) - plan_.joint(thigh));
        const Vector3d on_lap =
            pose[thigh].translation + 0.62 * (knee - pose[thigh].translation) + 0.11 * up - 0.05 * ahead;
        move_arm(left, on_lap, elbow_out, smooth(2 * now.amount - 1), pose);
        break;
      }
      case Act::phone:
        if (!left) {  // the hand reaches from before the shoulder up to the ear
          const Vector3d before = pose[upper].translation + 0.06 * up + 0.15 * ahead - 0.01 * to_left;
          move_arm(false, before, elbow_out, now.amount, pose);
        }
        break;
      case Act::talk: {
        const double beat = wave(time, 1.7, phase_[left ? 0 : 3]) * (0.6 + 0.4 * wave(time, 4.1, phase_[2]));
        const Vector3d front =
            pose[Bone::chest].translation + 0.33 * ahead + out * 0.17 * to_left + (0.02 + 0.09 * beat) * up;
        move_arm(left, front, elbow_out,
                 now.amount * (left ? 0.9 : smooth(0.6 + 0.6 * wave(time, 5, phase_[1]))), pose);
        break;
      }
      case Act::carry:
      case Act::place:
      case Act::pick: {
        const Pose box = held_box(time);
        const Vector3d grip = box * Vector3d(out * (0.5 * kBoxSize[0] + 0.035), 0.02, 0.09) - 0.10 * ahead;
        move_arm(left, grip, elbow_out, now.holding, pose);
        break;
      }
      case Act::push: {
        const Eigen::Vector2d way = forward(route_.at(time).yaw);
        Vector3d rest =
            pose[Bone::pelvis].translation + 0.37 * Vector3d(way.x(), way.y(), 0) + out * 0.16 * to_left;
        rest.z() = kSeatHeight + 0.61;  // on the back rest
        move_arm(left, rest, elbow_out, now.amount, pose);
        break;
      }
      case Act::idle:
        break;
    }
  }
}

BodyPose PersonMotion::pose(double time) const {
  const Stance body = route_.at(time);
  const Doing now = doing(time);
  const double stride = footsteps_.stride(time, body.yaw);
  BodyPose pose;
  pose[Bone::pelvis] = pelvis(time, body, now);
  pose_trunk(time, now, stride, pose);
  pose_legs(time, pose);
  pose_arms(time, now, stride, pose);
  return pose;
}

}  // namespace stdc
