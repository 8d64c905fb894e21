#include "simulation/people/footsteps.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/scene/motion_curves.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kToeOut = 0.11;                       // [rad]
constexpr double kBall = -0.125, kHeel = 0.055;        // y of where the foot rolls, from the ankle [m]
constexpr double kPushOff = 0.62, kHeelStrike = -0.3;  // pitch of the foot in a full stride [rad]
constexpr double kFullStride = 0.6;                    // [m]

/// Minimum jerk (Flash and Hogan 1985): how a limb goes from one place to another.
double min_jerk(double x) { return x * x * x * (10 + x * (-15 + 6 * x)); }

/// Time from one foot's landing to the other's. People step faster and farther the faster they walk (Grieve
/// and Gear 1966: about the square root of the speed each).
double step_time(double speed) {
  return std::clamp(1 / (1.72 * std::sqrt(std::max(speed, 0.2))), 0.45, 0.75);
}

}  // namespace

Footsteps::Footsteps(const Skeleton& skeleton, const Route& route, double end) : scale_(skeleton.scale()) {
  const Vector3d ankle = skeleton.joint(Bone::left_foot);
  half_width_ = ankle.x() + 0.008;
  ankle_ = {0, 0, ankle.z()};
  for (const int side : {kLeft, kRight}) start_[side] = planted_for(side, route.at(0));
  plan_steps(route, end);
}

Stance Footsteps::planted_for(int side, const Stance& body) const {
  const double out = side == kLeft ? 1 : -1;
  const Vector2d left(std::cos(body.yaw), std::sin(body.yaw));
  return {body.position + out * half_width_ * left, body.yaw + out * kToeOut};
}

void Footsteps::plan_steps(const Route& route, double end) {
  std::array<Stance, 2> now = start_;
  int next = kRight;
  double landed = -10, pause = 0;
  for (double t = 0; t < end; t += Route::kStep) {
    if (t < landed + pause) continue;
    const double pace = std::max(route.speed(t + 0.3), 0.25 * std::abs(route.yaw_rate(t + 0.3)));
    const double period = step_time(pace), swing = 0.8 * period;
    for (const int side : {next, 1 - next}) {
      // In the middle of the stance that follows, the foot is below the body.
      const Stance to = planted_for(side, route.at(t + swing + 0.6 * period));
      if ((to.position - now[side].position).norm() < 0.05 && std::abs(to.yaw - now[side].yaw) < 0.16)
        continue;
      steps_[side].push_back({t, t + swing, now[side], to});
      now[side] = to;
      next = 1 - side;
      landed = t + swing;
      pause = 0.2 * period;
      break;
    }
  }
}

Stance Footsteps::stance(int side, double time, double* swing, double* pitch) const {
  *swing = 0;
  *pitch = 0;
  const auto& steps = steps_[side];
  const auto after =
      std::upper_bound(steps.begin(), steps.end(), time, [](double t, const Step& s) { return t < s.lift; });
  Stance place = start_[side];
  if (after != steps.begin()) {
    const Step& s = *(after - 1);
    const double reach = std::min(1.0, (s.to.position - s.from.position).norm() / kFullStride);
    place = s.to;
    if (time < s.land) {
      const double u = (time - s.lift) / (s.land - s.lift), gone = min_jerk(u);
      *swing = u;
      *pitch = reach * (kPushOff + (kHeelStrike - kPushOff) * smooth(u * 1.15));
      place = {s.from.position + gone * (s.to.position - s.from.position),
               s.from.yaw + gone * (s.to.yaw - s.from.yaw)};
      return place;
    }
    *pitch = reach * kHeelStrike * (1 - smooth((time - s.land) / 0.13));
  }
  if (after != steps.end()) {  // the heel rises before the foot is lifted
    const double reach = std::min(1.0, (after->to.position - after->from.position).norm() / kFullStride);
    *pitch += reach * kPushOff * smooth(1 - (after->lift - time) / 0.24);
  }
  return place;
}

FootState Footsteps::foot(int side, double time) const {
  double swing = 0, pitch = 0;
  const Stance place = stance(side, time, &swing, &pitch);
  FootState state;
  state.planted = swing == 0;
  const double height = scale_ * 0.075 * 16 * swing * swing * (1 - swing) * (1 - swing);
  const Eigen::Quaterniond yaw(Eigen::AngleAxisd(place.yaw, Vector3d::UnitZ()));
  const Eigen::Quaterniond roll(Eigen::AngleAxisd(pitch, Vector3d::UnitX()));
  const Vector3d pivot(0, scale_ * (pitch > 0 ? kBall : kHeel), 0);
  const Vector3d ankle = pivot + roll * (ankle_ - pivot);
  state.world_from_foot =
      Pose(yaw * roll, Vector3d(place.position.x(), place.position.y(), height) + yaw * ankle);
  return state;
}

double Footsteps::stride(double time, double yaw) const {
  double swing = 0, pitch = 0;
  const Vector2d left = stance(kLeft, time, &swing, &pitch).position,
                 right = stance(kRight, time, &swing, &pitch).position;
  return (left - right).dot(forward(yaw));
}

double Footsteps::balance(double time) const {
  constexpr int kSamples = 9;
  constexpr double kSpan = 0.16;  // weight is shifted before and after the other foot is in the air [s]
  double sum = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double t = time + kSpan * (2.0 * i / (kSamples - 1) - 1);
    double left = 0, right = 0, pitch = 0;
    stance(kLeft, t, &left, &pitch);
    stance(kRight, t, &right, &pitch);
    sum += (left > 0 ? 1 : 0) - (right > 0 ? 1 : 0);
  }
  return sum / kSamples;
}

}  // namespace stdc::simulation
