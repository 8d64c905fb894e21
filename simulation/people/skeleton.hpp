#pragma once

#include <Eigen/Core>
#include <array>

namespace stdc::simulation {

/// The bones of a person. `left` and `right` are the person's own.
enum class Bone {
  pelvis,
  spine,
  chest,
  neck,
  head,
  left_upper_arm,
  left_forearm,
  left_hand,
  right_upper_arm,
  right_forearm,
  right_hand,
  left_thigh,
  left_shin,
  left_foot,
  right_thigh,
  right_shin,
  right_foot,
};
constexpr int kBones = 17;
constexpr int index(Bone bone) { return static_cast<int>(bone); }
/// The parent bone; the pelvis is its own.
Bone parent(Bone bone);
/// The same bone of the other side.
constexpr Bone mirrored(Bone bone) {
  const int i = index(bone);
  if (i < 5) return bone;
  const int block = i < 11 ? 5 : 11, at = (i - block + 3) % 6;
  return static_cast<Bone>(block + at);
}

/// Body measures of a person.
struct BodyMeasures {
  double height = 1.75;    ///< standing, without shoes [m]
  double girth = 1;        ///< of trunk and limbs, 1 is average
  double shoulders = 1;    ///< breadth, 1 is average
  double hips = 1;         ///< breadth, 1 is average
  double chest_depth = 0;  ///< of the bust, 0..1
};

/// The skeleton in its rest pose: standing on z = 0, facing -y (so +x is to the person's left), arms a little
/// away from the trunk. Proportions follow Winter, Biomechanics and Motor Control of Human Movement (2009),
/// fig. 4.1.
class Skeleton {
 public:
  explicit Skeleton(const BodyMeasures& measures);

  const BodyMeasures& measures() const { return measures_; }
  /// Height relative to a person of 1.75 m.
  double scale() const { return measures_.height / 1.75; }
  /// The joint that a bone rotates about [m].
  const Eigen::Vector3d& joint(Bone bone) const { return joints_[index(bone)]; }
  /// The far end of the bone.
  const Eigen::Vector3d& end(Bone bone) const { return ends_[index(bone)]; }
  /// Half the thickness of the body around the bone.
  double radius(Bone bone) const { return radii_[index(bone)]; }
  double length(Bone bone) const { return (end(bone) - joint(bone)).norm(); }

 private:
  void set(Bone bone, const Eigen::Vector3d& joint, const Eigen::Vector3d& end, double radius);

  BodyMeasures measures_;
  std::array<Eigen::Vector3d, kBones> joints_, ends_;
  std::array<double, kBones> radii_{};
};

}  // namespace stdc::simulation
