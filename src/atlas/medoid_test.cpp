#include "atlas/medoid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "atlas/test_scene.hpp"
#include "core/random.hpp"
#include "features/description/hamming.hpp"

namespace stdc {
namespace {

int chosen(const std::vector<Descriptor>& descriptors) {
  std::vector<const Descriptor*> pointers;
  pointers.reserve(descriptors.size());
  for (const Descriptor& d : descriptors) pointers.push_back(&d);
  return medoid(pointers);
}

TEST(Medoid, IsTheOneInTheMiddle) {
  Random random(1);
  const Descriptor centre = test::random_descriptor(random);
  std::vector<Descriptor> around(9, centre);
  for (int i = 0; i < 9; ++i) {
    if (i == 6) continue;
    for (int bit = 0; bit < 20; ++bit)
      around[i].bits[random.below(4)] ^= std::uint64_t{1} << random.below(64);
  }
  EXPECT_EQ(chosen(around), 6);
}

TEST(Medoid, AgreesWithItsDefinition) {
  Random random(2);
  for (int round = 0; round < 20; ++round) {
    std::vector<Descriptor> all;
    const int count = 3 + static_cast<int>(random.below(12));
    all.reserve(count);
    for (int i = 0; i < count; ++i) all.push_back(test::random_descriptor(random));
    int best = -1, min_median = 257;
    for (int i = 0; i < count; ++i) {
      std::vector<int> row;
      row.reserve(all.size());
      for (const Descriptor& other : all) row.push_back(hamming_distance(all[i], other));
      std::sort(row.begin(), row.end());
      if (row[count / 2] >= min_median) continue;
      min_median = row[count / 2];
      best = i;
    }
    EXPECT_EQ(chosen(all), best);
  }
}

TEST(Medoid, OfTwoIsTheFirst) {
  Random random(3);
  EXPECT_EQ(chosen({test::random_descriptor(random), test::random_descriptor(random)}), 0);
}

}  // namespace
}  // namespace stdc
