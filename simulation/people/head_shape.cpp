// The head with its hair, and the hands: the pieces that want a finer mesh.
#include <cmath>

#include "simulation/people/body_shape.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3f;

/// Lengths of the head are those of a person of 1.75 m; heads vary less than bodies.
class HeadFrame {
 public:
  explicit HeadFrame(const Skeleton& skeleton)
      : scale_(0.5F * (1 + static_cast<float>(skeleton.scale()))),
        shift_(static_cast<float>(skeleton.measures().height) - 1.75F * scale_) {}
  Vector3f at(float x, float y, float z) const { return {scale_ * x, scale_ * y, scale_ * z + shift_}; }
  Vector3f size(float x, float y, float z) const { return scale_ * Vector3f(x, y, z); }
  float size(float length) const { return scale_ * length; }

 private:
  float scale_, shift_;
};

void add_skull(const HeadFrame& h, Solid& s, float inflate) {
  s.ellipsoid(h.at(0, 0.018F, 1.662F), h.size(0.075F + inflate, 0.097F + inflate, 0.09F + inflate), 0);
  s.ellipsoid(h.at(0, -0.045F, 1.655F), h.size(0.064F + inflate, 0.05F + inflate, 0.072F + inflate), 0.03F);
}

void add_face(const HeadFrame& h, Solid& s) {
  s.ellipsoid(h.at(0, -0.032F, 1.598F), h.size(0.06F, 0.062F, 0.062F), 0.03F);  // jaws
  s.ball(h.at(0, -0.08F, 1.549F), h.size(0.022F), 0.03F);                       // chin
  for (const float x : {-1.0F, 1.0F}) {
    s.cone(h.at(x * 0.06F, 0.0F, 1.592F), h.at(x * 0.026F, -0.07F, 1.552F), h.size(0.016F), h.size(0.016F),
           0.025F);
    s.ball(h.at(x * 0.043F, -0.062F, 1.615F), h.size(0.023F), 0.03F);  // cheek bones
    s.cone(h.at(x * 0.012F, -0.092F, 1.657F), h.at(x * 0.047F, -0.075F, 1.66F), h.size(0.009F),
           h.size(0.009F), 0.018F);
    s.carve(h.at(x * 0.032F, -0.103F, 1.639F), h.size(0.017F, 0.016F, 0.012F), 0.014F);  // eye sockets
    s.ball(h.at(x * 0.031F, -0.080F, 1.639F), h.size(0.0135F), 0.003F);
    s.ellipsoid(h.at(x * 0.074F, 0.012F, 1.63F), h.size(0.009F, 0.02F, 0.032F), 0.008F,
                Eigen::Quaternionf(Eigen::AngleAxisf(x * 0.35F, Vector3f::UnitZ())));
    s.ball(h.at(x * 0.012F, -0.100F, 1.604F), h.size(0.0095F), 0.008F);  // wings of the nose
    s.cone(h.at(0, -0.096F, 1.578F), h.at(x * 0.02F, -0.088F, 1.577F), h.size(0.0075F), h.size(0.004F),
           0.008F);
    s.cone(h.at(0, -0.094F, 1.569F), h.at(x * 0.017F, -0.087F, 1.571F), h.size(0.0085F), h.size(0.004F),
           0.008F);
  }
  s.cone(h.at(0, -0.092F, 1.65F), h.at(0, -0.112F, 1.61F), h.size(0.008F), h.size(0.0115F), 0.012F);  // nose
  s.carve(h.at(0, -0.113F, 1.5735F), h.size(0.02F, 0.02F, 0.0018F), 0.004F);  // between the lips
}

BodyPart face_part(const Skeleton& skeleton) {
  BodyPart part;
  part.region = BodyRegion::head;
  part.cell = 0.006F;
  part.bones = {Bone::neck, Bone::head};
  const HeadFrame h(skeleton);
  add_skull(h, part.solid, 0);
  add_face(h, part.solid);
  const auto s = static_cast<float>(skeleton.scale());
  part.solid.cone(Vector3f(0, 0.03F, 1.44F) * s, h.at(0, 0.018F, 1.6F), 0.060F * s, 0.054F * s, 0.03F);
  part.solid.ball(h.at(0, -0.032F, 1.515F), h.size(0.012F), 0.03F);  // larynx
  return part;
}

/// Strands: fine ridges that run downward.
void comb(const HeadFrame& h, std::uint32_t seed, float depth, Solid& s) {
  const Vector3f middle = h.at(0, 0.01F, 1.66F);
  s.displace(
      [=](const Vector3f& p) {
        const float angle = std::atan2(p.x() - middle.x(), p.y() - middle.y());
        return depth * (noise3({angle * 9, p.z() * 14, 0}, seed) + 0.6F * noise3(p * 30, seed + 1));
      },
      2 * depth);
}

BodyPart hair_part(const Skeleton& skeleton, const PersonAppearance& appearance) {
  BodyPart part;
  part.region = BodyRegion::hair;
  part.cell = 0.008F;
  part.bones = {Bone::neck, Bone::head};
  const HeadFrame h(skeleton);
  Solid& s = part.solid;
  const bool is_long = appearance.hair == HairStyle::bob || appearance.hair == HairStyle::ponytail;
  const float depth = appearance.hair == HairStyle::cropped ? 0.006F : 0.016F;
  add_skull(h, s, depth);
  if (appearance.hair == HairStyle::parted)
    s.ellipsoid(h.at(0.02F, -0.045F, 1.735F), h.size(0.06F, 0.05F, 0.028F), 0.02F);
  if (appearance.hair == HairStyle::bob) {
    for (const float x : {-1.0F, 1.0F}) {
      s.cone(h.at(x * 0.07F, 0.025F, 1.64F), h.at(x * 0.078F, 0.02F, 1.535F), h.size(0.038F), h.size(0.03F),
             0.04F);
    }
    s.cone(h.at(0, 0.07F, 1.64F), h.at(0, 0.068F, 1.535F), h.size(0.06F), h.size(0.055F), 0.04F);
  }
  // The face stays free; the line of the hair goes round the forehead, the temples and behind the ears.
  s.carve(h.at(0, -0.115F, 1.6F), h.size(0.074F, 0.085F, 0.124F), 0.012F);
  for (const float x : {-1.0F, 1.0F}) {
    if (!is_long) s.carve(h.at(x * 0.095F, -0.03F, 1.59F), h.size(0.035F, 0.07F, 0.065F), 0.01F);
  }
  if (appearance.hair == HairStyle::ponytail) {
    s.ball(h.at(0, 0.125F, 1.685F), h.size(0.026F), 0.02F);
    s.cone(h.at(0, 0.135F, 1.68F), h.at(0, 0.15F, 1.58F), h.size(0.028F), h.size(0.03F), 0.02F);
    s.cone(h.at(0, 0.15F, 1.58F), h.at(0, 0.125F, 1.46F), h.size(0.03F), h.size(0.012F), 0.02F);
  }
  const float nape =
      appearance.hair == HairStyle::bob ? 1.5F : (appearance.hair == HairStyle::ponytail ? 1.44F : 1.585F);
  s.cut(h.at(0, 0, nape), {0, -0.25F, -1}, 0.008F);
  comb(h, static_cast<std::uint32_t>(appearance.seed) + 20,
       appearance.hair == HairStyle::cropped ? 0.0015F : 0.004F, s);
  return part;
}

}  // namespace

std::vector<BodyPart> head_parts(const Skeleton& skeleton, const PersonAppearance& appearance) {
  std::vector<BodyPart> parts;
  parts.push_back(face_part(skeleton));
  parts.push_back(hair_part(skeleton, appearance));
  return parts;
}

BodyPart hand_part(const Skeleton& skeleton, bool left) {
  BodyPart part;
  part.cell = 0.006F;
  const Bone hand = left ? Bone::left_hand : Bone::right_hand;
  part.bones = {hand};
  const auto s = static_cast<float>(skeleton.scale());
  const Vector3f wrist = skeleton.joint(hand).cast<float>();
  // Axes of the hand: along the fingers, forward (where the thumb is), and from the palm to the back of the
  // hand.
  const Vector3f along = (skeleton.end(hand) - skeleton.joint(hand)).normalized().cast<float>();
  const Vector3f forward = (Vector3f(0, -1, 0) - along * along.dot(Vector3f(0, -1, 0))).normalized();
  Vector3f back = along.cross(forward);
  if (back.x() * wrist.x() < 0) back = -back;
  const auto at = [&](float a, float f, float b) -> Vector3f {
    return wrist + s * (a * along + f * forward + b * back);
  };
  part.solid.cone(at(-0.02F, 0, 0), at(0.01F, 0, 0), 0.026F * s, 0.025F * s, 0);
  for (int i = 0; i < 4; ++i) {  // palm: the bones of the hand side by side
    const float f = 0.027F - 0.018F * static_cast<float>(i);
    part.solid.cone(at(0.008F, 0.5F * f, 0), at(0.088F - 0.003F * static_cast<float>(i), f, 0.003F),
                    0.016F * s, 0.013F * s, 0.014F);
    const float length = (i == 1 ? 0.084F : (i == 3 ? 0.062F : 0.076F));
    const Vector3f knuckle = at(0.088F - 0.003F * static_cast<float>(i), f, 0.003F);
    const Vector3f middle = knuckle + s * (0.55F * length * along - 0.012F * back);
    const Vector3f tip = middle + s * (0.42F * length * along - 0.026F * back);
    part.solid.cone(knuckle, middle, 0.0105F * s, 0.009F * s, 0.006F);
    part.solid.cone(middle, tip, 0.009F * s, 0.0072F * s, 0.004F);
  }
  part.solid.cone(at(0.015F, 0.022F, -0.004F), at(0.052F, 0.048F, -0.014F), 0.015F * s, 0.012F * s, 0.012F);
  part.solid.cone(at(0.052F, 0.048F, -0.014F), at(0.088F, 0.052F, -0.022F), 0.0115F * s, 0.0085F * s, 0.005F);
  return part;
}

}  // namespace stdc::simulation
