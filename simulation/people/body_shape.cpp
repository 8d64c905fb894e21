#include "simulation/people/body_shape.hpp"

#include <cmath>

namespace stdc::simulation {
namespace {

using Eigen::Vector3f;

/// Puts shapes given for a person of 1.75 m and average girth onto this one.
class Sculptor {
 public:
  Sculptor(const Skeleton& skeleton, float inflate, Solid& solid)
      : skeleton_(skeleton),
        scale_(static_cast<float>(skeleton.scale())),
        girth_(static_cast<float>(skeleton.measures().girth)),
        inflate_(inflate),
        solid_(solid) {}

  Vector3f at(float x, float y, float z) const { return scale_ * Vector3f(x * girth_, y * girth_, z); }
  float thick(float radius) const { return scale_ * girth_ * radius + inflate_; }
  Vector3f joint(Bone b) const { return skeleton_.joint(b).cast<float>(); }
  Vector3f end(Bone b) const { return skeleton_.end(b).cast<float>(); }

  void cone(const Vector3f& a, const Vector3f& b, float ra, float rb, float blend) {
    solid_.cone(a, b, thick(ra), thick(rb), blend);
  }
  void blob(const Vector3f& centre, const Vector3f& radii, float blend) {
    solid_.ellipsoid(centre, scale_ * girth_ * radii + Vector3f::Constant(inflate_), blend);
  }
  /// On both sides.
  void blobs(float x, float y, float z, const Vector3f& radii, float blend) {
    blob(at(x, y, z), radii, blend);
    blob(at(-x, y, z), radii, blend);
  }

 private:
  const Skeleton& skeleton_;
  float scale_, girth_, inflate_;
  Solid& solid_;
};

constexpr Bone kLeftArm[] = {Bone::left_upper_arm, Bone::left_forearm, Bone::left_hand};
constexpr Bone kRightArm[] = {Bone::right_upper_arm, Bone::right_forearm, Bone::right_hand};

void add_trunk(Sculptor& s, const BodyMeasures& m) {
  const auto hips = static_cast<float>(m.hips), bust = static_cast<float>(m.chest_depth);
  const auto shoulders = static_cast<float>(m.shoulders);
  s.blob(s.at(0, 0.005F, 0.965F), {0.160F * hips, 0.11F, 0.11F}, 0.02F);
  s.blobs(0.075F, 0.062F, 0.915F, {0.085F * hips, 0.078F, 0.085F}, 0.05F);
  s.blob(s.at(0, -0.004F, 1.10F), {0.142F, 0.104F, 0.16F}, 0.08F);
  s.blob(s.at(0, 0.004F, 1.29F), {0.152F * shoulders, 0.108F, 0.18F}, 0.06F);
  s.blobs(0.075F, -0.068F, 1.325F, {0.08F, 0.046F, 0.065F}, 0.05F);
  if (bust > 0)
    s.blobs(0.075F, -0.085F - 0.02F * bust, 1.285F, {0.062F, 0.062F * bust + 0.02F, 0.062F}, 0.04F);
  s.blobs(0.085F, 0.062F, 1.36F, {0.085F, 0.05F, 0.1F}, 0.06F);
  // Collar bones and the slope from the neck to the shoulders.
  for (const float side : {-1.0F, 1.0F}) {
    s.cone(s.at(side * 0.02F, 0.03F, 1.478F), s.at(side * 0.145F * shoulders, 0.015F, 1.422F), 0.04F, 0.044F,
           0.04F);
  }
}

void add_upper_arm(Sculptor& s, const Bone* arm, float from, float to) {
  const Vector3f a = s.joint(arm[0]), b = s.end(arm[0]), along = b - a;
  if (from <= 0) s.blob(a + Vector3f(0, 0, -0.016F), {0.050F, 0.054F, 0.060F}, 0.035F);
  s.cone(a + std::max(from, 0.0F) * along, a + to * along, 0.046F, 0.046F - 0.008F * to, 0.035F);
  if (to > 0.5F && from < 0.4F)
    s.blob(a + 0.48F * along + Vector3f(0, -0.01F, 0), {0.042F, 0.047F, 0.08F}, 0.03F);
}

void add_forearm(Sculptor& s, const Bone* arm) {
  const Vector3f a = s.joint(arm[1]), b = s.end(arm[1]), along = b - a;
  s.cone(a, a + 0.3F * along, 0.037F, 0.040F, 0.02F);
  s.cone(a + 0.3F * along, b, 0.040F, 0.026F, 0.02F);
}

BodyPart top_part(const Skeleton& skeleton, const PersonAppearance& appearance) {
  BodyPart part;
  part.region = BodyRegion::top;
  part.cell = 0.0145F;
  const auto loose = static_cast<float>(appearance.looseness), scale = static_cast<float>(skeleton.scale());
  Sculptor s(skeleton, 0.007F + 0.006F * loose, part.solid);
  add_trunk(s, appearance.measures);
  // Cloth hangs from the chest and bridges the waist.
  s.blob(s.at(0, -0.002F, 1.08F), {0.142F + 0.012F * loose, 0.106F + 0.008F * loose, 0.26F}, 0.05F);
  part.bones = {Bone::pelvis, Bone::spine, Bone::chest};
  for (const Bone* arm : {kLeftArm, kRightArm}) {
    add_upper_arm(s, arm, 0, appearance.long_sleeves ? 1.0F : 0.55F);
    part.bones.insert(part.bones.end(), {arm[0], arm[1]});
    const Vector3f elbow = s.joint(arm[1]), wrist = s.end(arm[1]);
    if (appearance.long_sleeves) {
      add_forearm(s, arm);
      const Vector3f direction = (wrist - elbow).normalized();
      part.solid.ring(wrist - 0.008F * direction, direction, s.thick(0.024F), 0.007F, 0.01F);
    }
  }
  if (!appearance.long_sleeves) {
    for (const Bone* arm : {kLeftArm, kRightArm}) {  // the hem of the sleeve stands off a little
      const Vector3f a = s.joint(arm[0]), direction = (s.end(arm[0]) - a).normalized();
      const float at = 0.55F * static_cast<float>(skeleton.length(arm[0])) + 0.02F;
      part.solid.ring(a + at * direction, direction, s.thick(0.044F), 0.006F, 0.012F);
    }
  }
  part.solid.cut(s.at(0, 0, 0.9F), {0, 0, -1}, 0.01F);
  part.solid.cut(s.at(0, 0, 1.502F), {0, -0.35F, 1}, 0.01F);
  part.solid.ring(s.at(0, 0.014F, 1.482F), {0, -0.32F, 1}, s.thick(0.052F), 0.010F, 0.015F);  // collar
  const auto seed = static_cast<std::uint32_t>(appearance.seed);
  const float depth = 0.003F + 0.003F * loose;
  part.solid.displace(
      [=](const Vector3f& p) {
        // Folds run across the limbs and are deepest about the waist and the elbows.
        const float wave = noise3({p.x() * 9, p.y() * 9, p.z() * 24 + 4 * std::abs(p.x())}, seed);
        const float broad = noise3(p * 7, seed + 1);
        const float waist = std::exp(-30 * (p.z() / scale - 1.03F) * (p.z() / scale - 1.03F));
        return depth * ((0.5F + waist) * wave + 0.7F * broad);
      },
      0.012F);
  return part;
}

BodyPart trousers_part(const Skeleton& skeleton, const PersonAppearance& appearance) {
  BodyPart part;
  part.region = BodyRegion::trousers;
  part.cell = 0.0145F;
  const auto loose = static_cast<float>(appearance.looseness);
  const auto hips = static_cast<float>(appearance.measures.hips);
  Sculptor s(skeleton, 0.006F + 0.004F * loose, part.solid);
  s.blob(s.at(0, 0.004F, 0.985F), {0.150F * hips, 0.106F, 0.11F}, 0.02F);
  s.blobs(0.075F, 0.06F, 0.915F, {0.080F * hips, 0.074F, 0.085F}, 0.03F);
  for (const Bone thigh : {Bone::left_thigh, Bone::right_thigh}) {
    const Bone shin = static_cast<Bone>(index(thigh) + 1);
    const Vector3f hip = s.joint(thigh), knee = s.joint(shin), ankle = s.end(shin), upper = knee - hip,
                   lower = ankle - knee;
    s.cone(hip + Vector3f(0, 0, -0.01F), knee, 0.080F, 0.055F, 0.018F);
    s.blob(hip + 0.42F * upper + Vector3f(hip.x() > 0 ? 0.008F : -0.008F, -0.012F, 0),
           {0.068F, 0.078F, 0.17F}, 0.02F);
    s.cone(knee, ankle + 0.12F * lower.norm() * Vector3f(0, 0, 1), 0.055F, 0.044F + 0.008F * loose, 0.03F);
    s.blob(knee + 0.3F * lower + Vector3f(0, 0.022F, 0), {0.046F, 0.048F, 0.12F}, 0.03F);
    s.cone(knee + 0.6F * lower, ankle, 0.045F + 0.006F * loose, 0.043F + 0.014F * loose, 0.03F);
    part.bones.insert(part.bones.end(), {thigh, shin});
  }
  part.bones.insert(part.bones.end(), {Bone::pelvis, Bone::spine});
  part.solid.cut(s.at(0, 0, 0.045F), {0, 0, -1}, 0.006F);
  part.solid.cut(s.at(0, 0, 1.06F), {0, 0, 1}, 0.006F);
  const auto seed = static_cast<std::uint32_t>(appearance.seed) + 7;
  const float depth = 0.004F + 0.003F * loose;
  const auto scale = static_cast<float>(skeleton.scale());
  part.solid.displace(
      [=](const Vector3f& p) {
        const float z = p.z() / scale;
        const float knee = std::exp(-60 * (z - 0.47F) * (z - 0.47F)),
                    hem = std::exp(-160 * (z - 0.1F) * (z - 0.1F));
        const float wave = noise3({p.x() * 10, p.y() * 10 + 3 * p.z(), p.z() * 26}, seed);
        return depth * ((0.25F + 0.7F * knee + hem) * wave + 0.5F * noise3(p * 8, seed + 1));
      },
      0.014F);
  return part;
}

BodyPart arm_part(const Skeleton& skeleton, const Bone* arm, bool long_sleeves) {
  BodyPart part;
  part.cell = 0.010F;
  Sculptor s(skeleton, 0, part.solid);
  if (!long_sleeves) {
    add_upper_arm(s, arm, 0.3F, 1);
    add_forearm(s, arm);
  } else {
    const Vector3f a = s.joint(arm[1]), b = s.end(arm[1]);
    s.cone(a + 0.7F * (b - a), b, 0.031F, 0.026F, 0.02F);
  }
  part.bones = {arm[0], arm[1]};
  return part;
}

/// Shoe and sole of one foot.
void add_shoe(const Skeleton& skeleton, Bone foot, std::vector<BodyPart>& parts) {
  BodyPart upper, sole;
  upper.region = BodyRegion::shoes;
  sole.region = BodyRegion::soles;
  upper.cell = sole.cell = 0.009F;
  upper.bones = sole.bones = {foot};
  const auto scale = static_cast<float>(skeleton.scale());
  const Vector3f ankle = skeleton.joint(foot).cast<float>();
  const auto at = [&](float x, float y, float z) -> Vector3f {
    return Vector3f(ankle.x(), ankle.y(), 0) + scale * Vector3f(x, y, z);
  };
  const float out = ankle.x() > 0 ? 1.0F : -1.0F;
  upper.solid.cone(ankle + Vector3f(0, 0.004F, 0.03F), at(0, 0.005F, 0.05F), 0.037F * scale, 0.042F * scale,
                   0);
  upper.solid.ellipsoid(at(0, 0.025F, 0.045F), scale * Vector3f(0.037F, 0.045F, 0.045F), 0.02F);
  upper.solid.cone(at(0, 0, 0.055F), at(0.006F * out, -0.12F, 0.04F), 0.038F * scale, 0.034F * scale, 0.03F);
  upper.solid.ellipsoid(at(0.006F * out, -0.13F, 0.032F), scale * Vector3f(0.046F, 0.075F, 0.034F), 0.03F);
  upper.solid.cut({0, 0, 0.012F}, {0, 0, -1}, 0.004F);
  sole.solid.ellipsoid(at(0, 0.022F, 0.015F), scale * Vector3f(0.041F, 0.055F, 0.03F), 0);
  sole.solid.cone(at(0, 0, 0.012F), at(0.006F * out, -0.12F, 0.012F), 0.038F * scale, 0.044F * scale, 0.03F);
  sole.solid.ellipsoid(at(0.006F * out, -0.13F, 0.015F), scale * Vector3f(0.05F, 0.082F, 0.03F), 0.02F);
  sole.solid.cut({0, 0, 0.026F}, {0, 0, 1}, 0.003F);
  sole.solid.cut({0, 0, 0.0F}, {0, 0, -1}, 0.002F);
  parts.push_back(std::move(upper));
  parts.push_back(std::move(sole));
}

std::uint32_t hashed(int x, int y, int z, std::uint32_t seed) {
  std::uint32_t h = seed * 0x9E3779B1U ^ static_cast<std::uint32_t>(x) * 0x85EBCA6BU ^
                    static_cast<std::uint32_t>(y) * 0xC2B2AE35U ^ static_cast<std::uint32_t>(z) * 0x27D4EB2FU;
  h = (h ^ h >> 15U) * 0x2C1B3C6DU;
  h = (h ^ h >> 12U) * 0x297A2D39U;
  return h ^ h >> 15U;
}

}  // namespace

float noise3(const Vector3f& p, std::uint32_t seed) {
  const Vector3f low = p.array().floor(), f = p - low;
  const Vector3f w = f.cwiseProduct(f).cwiseProduct(Vector3f::Constant(3) - 2 * f);
  float sum = 0;
  for (int i = 0; i < 8; ++i) {
    float weight = 1;
    for (int axis = 0; axis < 3; ++axis) weight *= (i >> axis & 1) != 0 ? w[axis] : 1 - w[axis];
    const std::uint32_t h =
        hashed(static_cast<int>(low.x()) + (i & 1), static_cast<int>(low.y()) + (i >> 1 & 1),
               static_cast<int>(low.z()) + (i >> 2 & 1), seed);
    sum += weight * (static_cast<float>(h >> 8U) * (2.0F / 16777216.0F) - 1);
  }
  return sum;
}

std::vector<BodyPart> body_parts(const Skeleton& skeleton, const PersonAppearance& appearance) {
  std::vector<BodyPart> parts = head_parts(skeleton, appearance);
  parts.push_back(top_part(skeleton, appearance));
  parts.push_back(trousers_part(skeleton, appearance));
  for (const Bone* arm : {kLeftArm, kRightArm})
    parts.push_back(arm_part(skeleton, arm, appearance.long_sleeves));
  for (const bool left : {true, false}) parts.push_back(hand_part(skeleton, left));
  for (const Bone foot : {Bone::left_foot, Bone::right_foot}) add_shoe(skeleton, foot, parts);
  return parts;
}

}  // namespace stdc::simulation
