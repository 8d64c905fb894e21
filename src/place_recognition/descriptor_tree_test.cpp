#include "place_recognition/descriptor_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "core/random.hpp"
#include "features/description/hamming.hpp"

namespace stdc {
namespace {

constexpr int kAllLeaves = 1 << 20;

Descriptor random_descriptor(Random& random) {
  Descriptor descriptor;
  for (auto& word : descriptor.bits) word = (std::uint64_t{random.next()} << 32U) | random.next();
  return descriptor;
}

Descriptor flipped(const Descriptor& original, int bits, Random& random) {
  Descriptor descriptor = original;
  for (int n = 0; n < bits; ++n) descriptor.bits[random.below(4)] ^= std::uint64_t{1} << random.below(64);
  return descriptor;
}

/// Many descriptors in clusters, as images give them, and a tree of them: the i-th belongs to owner i / 10.
struct Planted {
  std::vector<Descriptor> descriptors;
  DescriptorTree tree;

  explicit Planted(int count, std::uint64_t seed = 1) {
    Random random(seed);
    std::vector<Descriptor> corners;
    corners.reserve(100);
    for (int i = 0; i < 100; ++i) corners.push_back(random_descriptor(random));
    for (int i = 0; i < count; ++i) {
      descriptors.push_back(flipped(corners[random.below(100)], 60, random));
      tree.add(descriptors.back(), owner(i));
    }
  }
  static std::uint32_t owner(int i) { return static_cast<std::uint32_t>(i / 10); }
};

using Pairs = std::vector<std::pair<std::uint32_t, int>>;

Pairs sorted(const std::vector<DescriptorTree::Found>& found) {
  Pairs pairs;
  for (const auto& f : found) pairs.emplace_back(f.owner, f.distance);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs brute_force(const Planted& planted, const Descriptor& wanted, int max_distance,
                  const std::vector<std::uint8_t>& gone = {}) {
  Pairs pairs;
  for (int i = 0; i < static_cast<int>(planted.descriptors.size()); ++i) {
    if (!gone.empty() && gone[Planted::owner(i)] != 0) continue;
    const int distance = hamming_distance(planted.descriptors[i], wanted);
    if (distance <= max_distance) pairs.emplace_back(Planted::owner(i), distance);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(DescriptorTree, ASearchOfAllLeavesIsExact) {
  for (const int count : {0, 1, 200, 5000}) {
    const Planted planted(count);
    EXPECT_EQ(planted.tree.size(), static_cast<std::size_t>(count));
    Random random(7);
    for (int n = 0; n < 20; ++n) {
      const Descriptor wanted =
          count > 0 ? flipped(planted.descriptors[random.below(count)], 20, random) : Descriptor{};
      std::vector<DescriptorTree::Found> found;
      planted.tree.search(wanted, kAllLeaves, 90, found);
      EXPECT_EQ(sorted(found), brute_force(planted, wanted, 90));
    }
  }
}

TEST(DescriptorTree, OneLeafIsEnoughForTheSameDescriptor) {
  const Planted planted(20000);
  for (int i = 0; i < 20000; i += 37) {
    std::vector<DescriptorTree::Found> found;
    planted.tree.search(planted.descriptors[i], 1, 0, found);
    EXPECT_NE(std::find_if(found.begin(), found.end(),
                           [&](const auto& f) { return f.owner == Planted::owner(i) && f.distance == 0; }),
              found.end());
  }
}

TEST(DescriptorTree, MoreLeavesFindMore) {
  const Planted planted(20000);
  Random random(3);
  std::size_t few = 0, more = 0, all = 0;
  for (int n = 0; n < 300; ++n) {
    const Descriptor wanted = flipped(planted.descriptors[random.below(20000)], 25, random);
    std::vector<DescriptorTree::Found> one, four;
    planted.tree.search(wanted, 1, 40, one);
    planted.tree.search(wanted, 4, 40, four);
    few += one.size();
    more += four.size();
    all += brute_force(planted, wanted, 40).size();
  }
  EXPECT_GT(few, all / 2);
  EXPECT_GT(more, few);
  EXPECT_GT(more, all * 7 / 10);
}

TEST(DescriptorTree, SweepingTakesOutWhatIsGoneAndNothingElse) {
  Planted planted(5000);
  Random random(5);
  std::vector<std::uint8_t> gone(500);
  for (int round = 0; round < 4; ++round) {
    for (auto& g : gone) g = g != 0 || random.below(3) == 0 ? 1 : 0;
    planted.tree.sweep(gone);
    const auto kept = static_cast<std::size_t>(std::count(gone.begin(), gone.end(), 0)) * 10;
    EXPECT_EQ(planted.tree.size(), kept);
    for (int n = 0; n < 10; ++n) {
      const Descriptor& wanted = planted.descriptors[random.below(5000)];
      std::vector<DescriptorTree::Found> found;
      planted.tree.search(wanted, kAllLeaves, 90, found);
      EXPECT_EQ(sorted(found), brute_force(planted, wanted, 90, gone));
    }
  }
  std::fill(gone.begin(), gone.end(), 1);
  const std::size_t before = planted.tree.bytes();
  planted.tree.sweep(gone);
  EXPECT_EQ(planted.tree.size(), 0U);
  EXPECT_LT(planted.tree.bytes(), before / 100) << "empty branches are joined";
}

TEST(DescriptorTree, OfTheSameItTakesOneLeafAndNoMore) {
  DescriptorTree tree;
  for (std::uint32_t i = 0; i < 3000; ++i) tree.add(Descriptor{}, i);
  EXPECT_EQ(tree.size(), DescriptorTree::kLeafSize);
  std::vector<DescriptorTree::Found> found;
  tree.search(Descriptor{}, 1, 0, found);
  ASSERT_EQ(found.size(), DescriptorTree::kLeafSize);
  EXPECT_EQ(found.front().owner, 0U);
  Random random(1);
  std::vector<Descriptor> others;
  for (std::uint32_t i = 0; i < 3000; ++i) tree.add(others.emplace_back(random_descriptor(random)), 5000 + i);
  EXPECT_EQ(tree.size(), DescriptorTree::kLeafSize + 3000) << "what is different finds its place";
  for (std::uint32_t i = 0; i < 3000; ++i) {
    found.clear();
    tree.search(others[i], 1, 0, found);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found.front().owner, 5000 + i);
  }
}

}  // namespace
}  // namespace stdc
