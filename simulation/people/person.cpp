#include "simulation/people/person.hpp"

#include "core/random.hpp"

namespace stdc::simulation {

PersonAppearance random_appearance(int number, std::uint64_t seed) {
  Random random(seed * 31 + static_cast<std::uint64_t>(number), 61);
  PersonAppearance appearance;
  appearance.seed = seed * 977 + static_cast<std::uint64_t>(number) * 7919 + 5;
  BodyMeasures& m = appearance.measures;
  if ((static_cast<std::uint64_t>(number) + seed) % 2 == 0) {
    m.height = random.uniform(1.70, 1.90);
    m.girth = random.uniform(0.93, 1.1);
    m.shoulders = random.uniform(0.97, 1.05);
    appearance.hair = random.below(2) == 0 ? HairStyle::parted : HairStyle::cropped;
  } else {
    m.height = random.uniform(1.60, 1.76);
    m.girth = random.uniform(0.88, 1.02);
    m.shoulders = random.uniform(0.88, 0.93);
    m.hips = random.uniform(1.02, 1.1);
    m.chest_depth = random.uniform(0.4, 0.8);
    appearance.hair = random.below(2) == 0 ? HairStyle::bob : HairStyle::ponytail;
  }
  appearance.long_sleeves = random.below(5) < 3;
  appearance.looseness = random.uniform(0.4, 1.2);
  return appearance;
}

}  // namespace stdc::simulation
