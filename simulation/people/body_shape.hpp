#pragma once

#include <cstdint>
#include <vector>

#include "simulation/people/skeleton.hpp"
#include "simulation/people/solid.hpp"

namespace stdc::simulation {

/// The parts of a person that are coloured differently.
enum class BodyRegion { skin, head, hair, top, trousers, shoes, soles };
constexpr int kBodyRegions = 7;

enum class HairStyle { cropped, parted, bob, ponytail };

/// Build, hair and clothes of a person.
struct PersonAppearance {
  BodyMeasures measures;
  HairStyle hair = HairStyle::parted;
  bool long_sleeves = true;
  double looseness = 1;    ///< of the clothes: 0 tight, 1 casual
  std::uint64_t seed = 1;  ///< of folds, patterns and colours
};

/// One piece of a person at rest.
struct BodyPart {
  Solid solid;
  float cell = 0.012F;  ///< side of the quads it is meshed with [m]
  BodyRegion region = BodyRegion::skin;
  std::vector<Bone> bones;  ///< that may move it
};

/// All parts of a person, clothes included, in the rest pose of the skeleton.
std::vector<BodyPart> body_parts(const Skeleton& skeleton, const PersonAppearance& appearance);

// Parts that have a file of their own.
std::vector<BodyPart> head_parts(const Skeleton& skeleton, const PersonAppearance& appearance);
BodyPart hand_part(const Skeleton& skeleton, bool left);

/// Smooth noise in space, in [-1, 1], about one wave per unit of length.
float noise3(const Eigen::Vector3f& p, std::uint32_t seed);

}  // namespace stdc::simulation
