#pragma once

#include <cstdint>
#include <vector>

#include "simulation/people/body_plan.hpp"
#include "simulation/people/solid.hpp"

namespace stdc {

/// What a part of a person is covered with.
enum class Cover { skin, head, hair, top, trousers, shoes, soles };
constexpr int kCovers = 7;

enum class HairStyle { cropped, parted, bob, ponytail };

/// How a person is built and dressed.
struct PersonLook {
  BodyMeasures measures;
  HairStyle hair = HairStyle::parted;
  bool long_sleeves = true;
  double looseness = 1;    ///< of the clothes; 0 tight, 1 casual
  std::uint64_t seed = 1;  ///< of folds, patterns and colours
};

/// One piece of a person at rest.
struct BodyPart {
  Solid solid;
  float cell = 0.012F;  ///< side of the quads it wants [m]
  Cover cover = Cover::skin;
  std::vector<Bone> bones;  ///< that it may follow
};

/// All pieces of a person, clothes included, in the frame of the BodyPlan.
std::vector<BodyPart> body_parts(const BodyPlan& plan, const PersonLook& look);

// The pieces, each in a file of its own kind.
std::vector<BodyPart> head_parts(const BodyPlan& plan, const PersonLook& look);
BodyPart hand_part(const BodyPlan& plan, bool left);

/// Smooth noise over space in [-1, 1], one wave per unit.
float noise3(const Eigen::Vector3f& p, std::uint32_t seed);

}  // namespace stdc
