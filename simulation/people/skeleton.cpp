#include "simulation/people/skeleton.hpp"

#include <cmath>

namespace stdc::simulation {

using Eigen::Vector3d;

Bone parent(Bone bone) {
  switch (bone) {
    case Bone::pelvis:
    case Bone::spine:
    case Bone::left_thigh:
    case Bone::right_thigh:
      return Bone::pelvis;
    case Bone::chest:
      return Bone::spine;
    case Bone::neck:
    case Bone::left_upper_arm:
    case Bone::right_upper_arm:
      return Bone::chest;
    default:
      return static_cast<Bone>(index(bone) - 1);
  }
}

void Skeleton::set(Bone bone, const Vector3d& joint, const Vector3d& end, double radius) {
  const double s = scale();
  joints_[index(bone)] = s * joint;
  ends_[index(bone)] = s * end;
  radii_[index(bone)] = s * radius * measures_.girth;
  const Bone other = mirrored(bone);
  if (other == bone) return;
  const Vector3d mirror(-1, 1, 1);
  joints_[index(other)] = s * joint.cwiseProduct(mirror);
  ends_[index(other)] = s * end.cwiseProduct(mirror);
  radii_[index(other)] = radii_[index(bone)];
}

Skeleton::Skeleton(const BodyMeasures& measures) : measures_(measures) {
  const double shoulder = 0.176 * measures.shoulders, hip = 0.088 * measures.hips;
  constexpr double kArmSpread = 0.44;  // of the arms from the vertical [rad]
  const Vector3d down(std::sin(kArmSpread), 0, -std::cos(kArmSpread));
  const Vector3d down_forward =
      Vector3d(std::sin(kArmSpread * 0.9), -0.12, -std::cos(kArmSpread * 0.9)).normalized();
  const Vector3d arm(shoulder, 0.012, 1.428), elbow = arm + 0.305 * down,
                                              wrist = elbow + 0.255 * down_forward;
  const Vector3d waist(0, 0.005, 1.06), breast(0, 0.012, 1.22), neck(0, 0.022, 1.475), head(0, 0.005, 1.565);
  const Vector3d thigh(hip, 0, 0.922), knee(hip + 0.002, -0.006, 0.498), ankle(hip + 0.004, 0.02, 0.082);
  set(Bone::pelvis, {0, 0, 0.945}, waist, 0.15);
  set(Bone::spine, waist, breast, 0.135);
  set(Bone::chest, breast, neck, 0.15);
  set(Bone::neck, neck, head, 0.055);
  set(Bone::head, head, {0, 0, 1.75}, 0.09);
  set(Bone::left_upper_arm, arm, elbow, 0.05);
  set(Bone::left_forearm, elbow, wrist, 0.036);
  set(Bone::left_hand, wrist, wrist + 0.18 * down_forward, 0.03);
  set(Bone::left_thigh, thigh, knee, 0.075);
  set(Bone::left_shin, knee, ankle, 0.05);
  set(Bone::left_foot, ankle, {hip + 0.012, -0.16, 0.03}, 0.045);
}

}  // namespace stdc::simulation
