#include "features/description/matching.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "features/description/hamming.hpp"

namespace stdc {
namespace {

FrameFeatures random_frame(int count, std::uint64_t seed) {
  Random random(seed);
  Features features;
  features.keypoints.resize(count);
  features.descriptors.resize(count);
  for (int i = 0; i < count; ++i) {
    features.keypoints[i].x = static_cast<float>(random.uniform(0, 639));
    features.keypoints[i].y = static_cast<float>(random.uniform(0, 479));
    features.keypoints[i].level = static_cast<std::uint8_t>(random.below(3));
    for (auto& word : features.descriptors[i].bits)
      word = (std::uint64_t{random.next()} << 32U) | random.next();
  }
  return {Camera(), std::move(features), {}, 1.2, 3, nullptr};
}

TEST(Matching, HammingCountsBits) {
  Descriptor a, b;
  EXPECT_EQ(hamming_distance(a, b), 0);
  for (auto& word : b.bits) word = ~std::uint64_t{0};
  EXPECT_EQ(hamming_distance(a, b), 256);
  b = a;
  b.bits[2] = 0b1011;
  EXPECT_EQ(hamming_distance(a, b), 3);
}

TEST(Matching, WindowSearchEqualsASearchOfAll) {
  const FrameFeatures frame = random_frame(500, 1);
  const FrameFeatures queries = random_frame(50, 2);
  std::vector<std::uint8_t> taken(frame.size());
  for (int i = 0; i < frame.size(); i += 7) taken[i] = 1;
  for (int q = 0; q < queries.size(); ++q) {
    const SearchWindow window{queries.pixel(q).x(), queries.pixel(q).y(), 80, 1, 2};
    const BestMatch found = match_in_window(frame, queries.descriptor(q), window, taken);
    std::vector<int> distances;
    for (int i = 0; i < frame.size(); ++i) {
      if (taken[i] == 0 && frame.keypoint(i).level >= 1 && std::abs(frame.pixel(i).x() - window.x) <= 80 &&
          std::abs(frame.pixel(i).y() - window.y) <= 80) {
        distances.push_back(hamming_distance(queries.descriptor(q), frame.descriptor(i)));
      }
    }
    std::sort(distances.begin(), distances.end());
    ASSERT_GE(distances.size(), 2U);
    EXPECT_EQ(found.distance, distances[0]);
    EXPECT_EQ(found.second, distances[1]);
  }
}

TEST(Matching, AcceptsByDistanceAndByRatioOnTheSameLevel) {
  BestMatch match{3, 40, 1, 45, 1};
  EXPECT_FALSE(match.accepted(64, 0.8));
  match.second_level = 2;
  EXPECT_TRUE(match.accepted(64, 0.8)) << "a rival on another level may be the same corner";
  EXPECT_FALSE(match.accepted(30, 0.8));
  EXPECT_FALSE(BestMatch().accepted(256, 1));
}

TEST(Matching, MatchAllFindsAPermutation) {
  const FrameFeatures a = random_frame(200, 3);
  Features rotated;
  for (int i = 0; i < a.size(); ++i) {
    const int j = (i * 77 + 5) % a.size();
    rotated.keypoints.push_back(a.keypoint(j));
    rotated.descriptors.push_back(a.descriptor(j));
    rotated.descriptors.back().bits[0] ^= 0xFF;  // eight bits of noise
  }
  const FrameFeatures b(Camera(), std::move(rotated), {}, 1.2, 3, nullptr);
  const std::vector<std::uint8_t> all(a.size(), 1);
  const auto pairs = match_all(a, all, b, 50, 0.8);
  EXPECT_EQ(pairs.size(), 200U);
  for (const KeypointPair& pair : pairs) EXPECT_EQ(pair.first, (pair.second * 77 + 5) % a.size());
}

TEST(Matching, RotationsThatDisagreeAreDropped) {
  std::vector<float> rotations(60, 0.5F);
  rotations[10] = 2.5F;
  rotations[20] = -2.0F;
  rotations[30] = 0.5F + 6.2831853F;
  const auto keep = consistent_rotations(rotations);
  EXPECT_EQ(keep[10], 0);
  EXPECT_EQ(keep[20], 0);
  EXPECT_EQ(keep[30], 1);
  EXPECT_EQ(keep[0], 1);
  EXPECT_TRUE(consistent_rotations({}).empty());
}

}  // namespace
}  // namespace stdc
